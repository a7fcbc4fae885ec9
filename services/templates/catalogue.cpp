// All that a form, --help and the API say about options is from here, and so are the limits. Limits
// of one option only: what does not fit together is refused where the geometry is known
// (templates.cpp and each template's file).
//
// Lengths follow the height by default, so that one number makes a whole dam; rates and ratios do
// not.
#include "services/templates/catalogue.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "core/fault/fault.hpp"
#include "core/scene/resolution.hpp"
#include "core/words/number.hpp"
#include "services/earthquake/earthquake.hpp"

namespace breach::templates {

using nlohmann::json;

namespace {

using Options = std::vector<Option>;

Option length(const std::string& name, double least, double most, double value, std::string help) {
    return {name, Kind::number, "m", least, most, value, "", 0.0, std::move(help)};
}

/// The default is a share of the height.
Option sized(const std::string& name, double share, double least, double most, std::string help) {
    return {name, Kind::number, "m", least, most, 0.0, "height", share, std::move(help)};
}

Option ratio(const std::string& name, double least, double most, double value, std::string help) {
    return {name, Kind::number, "1", least, most, value, "", 0.0, std::move(help)};
}

Option count(const std::string& name, int least, int most, int value, std::string help) {
    return {name,
            Kind::whole,
            "1",
            static_cast<double>(least),
            static_cast<double>(most),
            static_cast<double>(value),
            "",
            0.0,
            std::move(help)};
}

Option yes_or_no(const std::string& name, bool value, std::string help) {
    return {name, Kind::yes_or_no, "1", 0.0, 1.0, value ? 1.0 : 0.0, "", 0.0, std::move(help)};
}

Option of_type(Option option, const char* unit) {
    option.unit = unit;
    return option;
}

/// Of every template.
Options foundation_options() {
    return {
        sized("foundation_depth", 1.0 / 6, 0, 100,
              "ground below y = 0; 0: the soil stands on rock"),
        sized("foundation_extent", 2, 1, 5000,
              "ground that is modelled beyond the toe; the soil runs on over level terrain"),
        length("clay_thickness", 0, 100, 0,
               "weak layer at the top of the foundation; 0: there is none"),
        of_type(ratio("clay_strength", 1, 500, 40, "undrained strength of the weak layer"), "kPa"),
    };
}

/// Options of the dams.
Options site() {
    return {
        ratio("valley_slope", 0, 0.2, 0,
              "rise of the ground upstream of the toe, metres per metre"),
        ratio("ground_slope", 0, 0.2, 0,
              "fall of the ground downstream of the toe, metres per metre"),
        length("piezometer_depth", 0, 200, 0,
               "measured depth of the water below the crest's upstream edge; 0: Dupuit's parabola"),
        length("slimes_distance", 0, 5000, 0,
               "slimes begin that far behind the dam; 0: beach to the model's end"),
        ratio("slimes_ratio", 0.05, 1, 0.22,
              "undrained strength of the slimes over sigma'_v0 (Mesri 1989: 0.22); they soften to "
              "residual_ratio"),
    };
}

Options soil(double residual_ratio) {
    return {
        sized("layer_thickness", 1.0 / 6, 0.1, 100,
              "layers by depth below the phreatic line, which liquefy one after the other"),
        ratio("residual_ratio", 0.01, 0.5, residual_ratio,
              "residual strength of liquefied soil over sigma'_v0 (Olson & Stark 2002: 0.05 to "
              "0.12)"),
        ratio("peak_ratio", 0.05, 1, 0.27,
              "undrained strength before it liquefies, over sigma'_v0 (Olson & Stark 2003: 0.2 to "
              "0.3)"),
    };
}

Options computation() {
    return {
        sized("runout_extent", 10, 10, 20000, "how far beyond the toe the soil can be followed"),
        sized(
            "cell_size", 1.0 / scene::cells_over_height, 0.05, 20,
            "cells of the runout, at most half of clay_thickness by default; halve it for a result "
            "to rely on"),
    };
}

/// Options of the dams only: the FEM of a slope or heap of loose sand entangles within seconds, and
/// the remaining energy is too small for a runout.
Options earthquake() {
    return {
        sized("element_size", 0.1, 0.05, 50, "elements, with with_fem"),
        yes_or_no("with_fem", false,
                  "yes: shaken by a synthetic earthquake (PM4Sand, FEM, transfer, runout); no: "
                  "liquefied at rest (LEM and runout)"),
        of_type(ratio("pga", earthquake::least_pga, earthquake::most_pga, earthquake::Motion{}.pga,
                      "peak acceleration of the outcrop motion, with with_fem"),
                "g"),
        of_type(length("shaking", earthquake::least_shaking, earthquake::most_shaking,
                       earthquake::Motion{}.shaking, "length of the motion, with with_fem"),
                "s"),
    };
}

Options joined(std::initializer_list<Options> all) {
    Options joined;
    for (const Options& each : all) joined.insert(joined.end(), each.begin(), each.end());
    return joined;
}

/// beach: length of the dry beach, heights: of the pond, both over the dam's height.
Options pond(double beach, double heights) {
    return {
        sized("freeboard", 1.0 / 20, 0.1, 50,
              "height of the crest above the beach where they meet"),
        sized("beach_length", beach, 0, 5000, "dry beach between the dam and the pond's edge"),
        ratio("beach_slope", 0, 0.1, 0.01, "fall of the beach, metres per metre"),
        sized("pond_length", heights, 1, 5000,
              "tailings below the pond that are modelled, from its edge upstream"),
        length("pond_depth", 0, 50, 0,
               "water at the pond's edge when the dam fails, above the tailings and in the runout; "
               "0: none"),
    };
}

/// faces: of the dam, with its crest; ponded: the beach and its water.
Options dam(int raises, Options faces, Options ponded, Option drain) {
    return joined({{
                       length("height", 3, 200, 30, "crest of the last raise above the foundation"),
                       sized("starter_height", 1.0 / 3, 1, 200, "of the starter dam"),
                       yes_or_no("rockfill_starter", false,
                                 "yes: the starter dam is of rockfill, not of the raises' fill"),
                       count("raises", 0, 20, raises,
                             "raises of equal height; 0: the starter dam is as high as the dam"),
                   },
                   std::move(faces),
                   std::move(ponded),
                   {std::move(drain)},
                   soil(earthquake::usual_residual_ratio),
                   foundation_options(),
                   site(),
                   computation(),
                   earthquake()});
}

Option crest_width() {
    return sized("crest_width", 1.0 / 5, 0.5, 100, "of the starter dam and of each raise");
}

Template upstream() {
    return {
        "upstream_dam", "Tailings dam with a starter dam and upstream raises on tailings",
        dam(4,
            {
                ratio("starter_slope", 1, 10, 2,
                      "downstream face of the starter dam, metres across per metre up"),
                ratio("raise_slope", 1, 10, 3,
                      "downstream face of the first raise, metres across per metre up"),
                of_type({"last_raise_slope", Kind::number, "", 1, 10, 0, "raise_slope", 1,
                         "downstream face of the last raise; those between have slopes between"},
                        "1"),
                ratio("upstream_slope", 0.5, 10, 2, "upstream faces, metres across per metre up"),
                crest_width(),
                sized("bench_width", 1.0 / 15, 0, 50, "crest that a raise leaves free downstream"),
            },
            pond(3, 7.5),  // the end lies 10.5 heights behind the crest (upstream_wall)
            yes_or_no("drain", false,
                      "yes: the phreatic line ends at the starter dam's heel; no: at its toe"))};
}

Template downstream() {
    return {
        "downstream_dam", "Tailings dam with a starter dam and downstream raises on the foundation",
        dam(2,
            {
                ratio("downstream_slope", 1, 10, 2, "downstream faces, metres across per metre up"),
                ratio("upstream_slope", 0.5, 10, 2, "upstream face, metres across per metre up"),
                crest_width(),
            },
            pond(1, 2),
            yes_or_no("drain", true,
                      "yes: the phreatic line ends in a drain below the middle of the crest; no: "
                      "at the toe"))};
}

Template plain_slope() {
    return {
        "slope", "Slope of loose, partly saturated soil above level ground",
        joined(
            {{
                 length("height", 1, 200, 10, "of the slope"),
                 ratio("face_slope", 0.3, 10, 2, "face of the slope, metres across per metre up"),
                 sized("crest_extent", 3, 1, 2000,
                       "level ground behind the crest that is modelled"),
                 sized("water_depth", 0.4, 0, 200,
                       "phreatic line below ground at the model's upper end; it ends at the toe"),
             },
             soil(0.1),
             foundation_options(),
             computation()})};
}

Template leach_heap() {
    return {
        "heap", "Heap in lifts with benches, wet at its base, one half of it",
        joined({{
                    length("height", 2, 300, 30, "of the heap"),
                    count("lifts", 1, 30, 3, "lifts of equal height"),
                    ratio("lift_slope", 0.5, 10, 1.4,
                          "faces of the lifts, metres across per metre up"),
                    sized("bench_width", 1.0 / 3, 0, 100, "between two lifts"),
                    sized("top_width", 1, 1, 2000, "level top from the heap's axis to its edge"),
                    sized("water_height", 0.5, 0, 300,
                          "phreatic line above the base at the heap's axis; it ends at the toe"),
                },
                soil(0.08),
                foundation_options(),
                computation()})};
}

/// Computes defaults that follow another option from that option's default.
/// A follower's own default is shown where the leader has its default; completed() computes it anew
/// for another leader.
Template with_values(Template made) {
    for (Option& each : made.options) {
        if (each.follows.empty()) continue;
        const auto leader = std::ranges::find(made.options, each.follows, &Option::name);
        each.value = each.share * leader->value;
    }
    return made;
}

const char* type_of(Kind kind) {
    switch (kind) {
        case Kind::number:
            return "number";
        case Kind::whole:
            return "integer";
        case Kind::yes_or_no:
            return "boolean";
    }
    return "";
}

/// The group of an option in a form: "section" unless it is listed here.
/// The topics are those of the page that draws a new scene.
const char* topic_of(const std::string& name) {
    static const std::map<std::string, const char*> topics{
        {"layer_thickness", "soils"}, {"residual_ratio", "soils"},
        {"peak_ratio", "soils"},      {"clay_strength", "soils"},
        {"slimes_ratio", "soils"},    {"piezometer_depth", "water"},
        {"freeboard", "water"},       {"beach_length", "water"},
        {"beach_slope", "water"},     {"pond_length", "water"},
        {"pond_depth", "water"},      {"drain", "water"},
        {"water_depth", "water"},     {"water_height", "water"},
        {"with_fem", "water"},        {"pga", "water"},
        {"shaking", "water"},         {"runout_extent", "question"},
        {"cell_size", "question"},    {"element_size", "question"}};
    const auto found = topics.find(name);
    return found == topics.end() ? "section" : found->second;
}

json as_json(const Option& option) {
    json described{{"name", option.name},          {"topic", topic_of(option.name)},
                   {"type", type_of(option.kind)}, {"unit", option.unit},
                   {"default", option.value},      {"help", option.help}};
    if (option.kind == Kind::yes_or_no) {
        described["default"] = option.value > 0.5;
        return described;
    }
    // Without a decimal point, so that a form shows 4 and not 4.0.
    if (option.kind == Kind::whole) {
        described["default"] = static_cast<int>(option.value);
        described["minimum"] = static_cast<int>(option.least);
        described["maximum"] = static_cast<int>(option.most);
        return described;
    }
    described["minimum"] = option.least;
    described["maximum"] = option.most;
    if (!option.follows.empty()) {
        described["rule"] = rule_of(option);
        described["follows"] = option.follows;
        described["share"] = option.share;
    }
    return described;
}

}  // namespace

/// Made once; templates are constant while the program runs.
const std::vector<Template>& catalogue() {
    static const std::vector<Template> all{with_values(upstream()), with_values(downstream()),
                                           with_values(plain_slope()), with_values(leach_heap())};
    return all;
}

const Template& named(const std::string& name) {
    std::string known;
    for (const Template& each : catalogue()) {
        if (each.name == name) return each;
        known += (known.empty() ? "" : ", ") + each.name;
    }
    throw fault::BadInput("template " + name,
                          {{"", "there is no template \"" + name + "\"", "take one of: " + known}});
}

std::string rule_of(const Option& option) {
    if (option.follows.empty()) return "";
    const double part = 1.0 / option.share;
    // "height / 6" reads better than "0.1667 height".
    const bool divides = option.share < 1.0 && std::abs(part - std::round(part)) < 1e-9;
    if (option.share == 1.0) return option.follows;
    return divides ? option.follows + " / " + std::to_string(std::lround(part))
                   : words::text_of(option.share) + " " + option.follows;
}

json as_json(const std::vector<Template>& templates) {
    json all = json::array();
    for (const Template& each : templates) {
        json options = json::array();
        for (const Option& option : each.options) options.push_back(as_json(option));
        all.push_back({{"name", each.name}, {"title", each.title}, {"options", options}});
    }
    return {{"templates", all}};
}

}  // namespace breach::templates
