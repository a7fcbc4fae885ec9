// What liquefies at rest is what lies below the phreatic line of the named regions. Its strength is
// a profile by sigma'_v0, so that no layers by depth are needed; if there are any, the stability
// analysis liquefies them one after the other. A user must give each residual strength with its
// source: nothing else decides the runout as much.
//
// A pond is the phreatic line above the ground behind the crest; variants are without it. It acts by
// its weight in the stability analysis and by its pore pressure in both. The runout has no
// /mpm/water: water that stays full when its dam has gone would hold the scarp back.
#include "services/import/liquefy.hpp"

#include <algorithm>
#include <set>

#include "core/words/list.hpp"
#include "core/words/number.hpp"
#include "services/earthquake/soils.hpp"
#include "services/import/numbers.hpp"
#include "services/import/shake.hpp"
#include "services/templates/assembly.hpp"
#include "services/templates/wet_fill.hpp"

namespace breach::importing {

using nlohmann::json;

namespace {

constexpr const char* form =
    "REGION=0.08,SOURCE (share of sigma'_v0) or REGION=4kPa,SOURCE; with the peak: "
    "REGION=0.08,0.27,SOURCE";

/// Limits and usual values are those of the templates.
const templates::Option& option(const char* name) {
    return *std::ranges::find(templates::named("upstream_dam").options, name,
                              &templates::Option::name);
}

std::optional<Undrained> undrained_in(std::string_view text) {
    text = trimmed(text);
    const bool in_kPa = lower(std::string(text)).ends_with("kpa");
    if (in_kPa) text.remove_suffix(3);
    const auto value = number_in(text);
    if (!value) return std::nullopt;
    return Undrained{*value, in_kPa};
}

std::string text_of(const Undrained& strength) {
    return words::text_of(strength.value) + (strength.in_kPa ? " kPa" : " sigma'_v0");
}

/// Whether the strength is within the limits of this option of the templates; else a fault.
bool is_sound(const Undrained& strength, const std::string& entry, const char* name,
              std::vector<Fault>& faults) {
    const templates::Option& ratio = option(name);
    constexpr double most = 500.0;  // kPa
    if (strength.in_kPa ? strength.value > 0.0 && strength.value <= most
                        : strength.value >= ratio.least && strength.value <= ratio.most)
        return true;
    faults.push_back({"liquefied", "\"" + entry + "\": the strength is " + text_of(strength),
                      "give " + words::text_of(ratio.least) + " to " + words::text_of(ratio.most) +
                          " (share of sigma'_v0), or at most " + words::text_of(most) +
                          " kPa, as 4kPa"});
    return false;
}

/// Whether the request names this soil, whose name may be that of a part.
bool means(const LiquefiedRequest& request, const Soil& soil) {
    const std::string name = lower(request.region);
    return name == lower(soil.name) || name == lower(soil.cut_from) || name == lower(soil.layer);
}

/// Those of the wet parts that are named.
const LiquefiedRequest* request_of(const Soil& soil, const std::vector<LiquefiedRequest>& asked) {
    const auto found =
        std::ranges::find_if(asked, [&](const auto& each) { return means(each, soil); });
    return soil.depth_layer > 0 && found != asked.end() ? &*found : nullptr;
}

json profile_of(const Undrained& strength) {
    if (strength.in_kPa) return {{"type", "undrained"}, {"s_u_kPa", strength.value}};
    return {{"type", "undrained_ratio"}, {"ratio", strength.value}, {"minimum_kPa", 1}};
}

Undrained peak_of(const LiquefiedRequest& request) {
    return request.peak.value_or(Undrained{option("peak_ratio").value, false});
}

/// "residual strength 0.08 sigma'_v0, peak 0.27 sigma'_v0 (as in "breach new"): CPTu 2024"
std::string strengths_of(const LiquefiedRequest& request) {
    return "residual strength " + text_of(request.residual) + ", peak " +
           text_of(peak_of(request)) + (request.peak ? "" : " (as in \"breach new\")") + ": " +
           request.source;
}

/// The soil's own strength stays that of the stability analysis before it liquefies.
json liquefied_of(const json& own, const LiquefiedRequest& request) {
    const json& law = own.at("law");
    json made = earthquake::undrained(
        earthquake::tailings, 0.0,
        strengths_of(request) + "; limit_strength is drained, before it liquefies");
    made["density"] = own.at("density");
    made["limit_strength"] = own.value(
        "limit_strength", json{{"c_kPa", law.at("c_kPa")}, {"phi_deg", law.at("phi_deg")}});
    made["law"] = {{"type", "mohr_coulomb"}, {"E_MPa", law.at("E_MPa")}, {"nu", made["law"]["nu"]}};
    made["strength"]["peak"] = made["strength"]["residual"] = profile_of(request.residual);
    return made;
}

/// The phreatic line without what is above the ground left of `until`.
std::vector<Vec2> without_pond(const std::vector<Vec2>& line, const std::vector<Vec2>& ground,
                               double until) {
    std::set<double> xs{until};
    for (const auto* each : {&line, &ground})
        for (const Vec2& point : *each) xs.insert(point.x());
    const auto above = [&](double x) {
        const bool is_behind = x >= ground.front().x() && x <= until;
        return is_behind ? geometry::level_at(line, x) - geometry::level_at(ground, x) : 0.0;
    };
    std::vector<Vec2> lowered;
    const auto add = [&](double x) {
        lowered.emplace_back(x, geometry::level_at(line, x) - std::max(above(x), 0.0));
    };
    double before = *xs.begin();
    for (const double x : xs) {
        const double a = above(before), b = above(x);
        if (a * b < 0.0) add(before + (x - before) * a / (a - b));  // the pond's edge
        add(before = x);
    }
    return lowered;
}

std::string assigned(const std::string& pointer, const json& value) {
    return pointer + "=" + value.dump();
}

json joined(json some, const json& more) {
    for (const json& each : more) some.push_back(each);
    return some;
}

/// Gives the wet parts their materials and liquefies them from the top down. Returns the overrides
/// of a variant in which they have their peak strength.
json take_strengths(const std::vector<LiquefiedRequest>& asked, const std::vector<Soil>& soils,
                    Document& document) {
    json& scene = document.scene;
    const json given = scene.at("materials");
    json made = json::object(), peaks = json::array(), undrained = json::array();
    std::vector<const Soil*> wet;
    for (std::size_t i = 0; i < soils.size(); ++i) {
        const LiquefiedRequest* request = request_of(soils[i], asked);
        if (request == nullptr) continue;
        wet.push_back(&soils[i]);
        const json material = liquefied_of(given.at(soils[i].material), *request);
        std::string name = soils[i].material + "_liquefied";
        while (made.contains(name) && made[name] != material) name += "_b";
        scene["section"]["regions"][i]["material"] = name;
        const Undrained peak = peak_of(*request);
        undrained.push_back({{"region", soils[i].name}});
        undrained.back()[peak.in_kPa ? "strength_kPa" : "coefficient_kPa"] =
            peak.value * (peak.in_kPa ? 1.0 : earthquake::atmosphere);
        if (made.contains(name)) continue;
        made[name] = material;
        peaks.push_back(assigned("/materials/" + name + "/strength/peak", profile_of(peak)));
        document.remarks.push_back(name + ": " + strengths_of(*request));
    }
    scene["materials"].update(made);
    peaks.push_back(assigned("/lem/undrained", undrained));
    std::ranges::stable_sort(wet, {}, &Soil::depth_layer);
    for (const Soil* each : wet) scene["lem"]["liquefaction"].push_back({{"region", each->name}});
    return peaks;
}

/// As the templates search: a liquefied slope fails from farther behind than one that is sound, and
/// through its face. left: end of the section [m].
void search_all_of(const Slope& slope, double left, Document& document) {
    json& search = document.scene["lem"]["search"];
    const double H = slope.fall(), face = slope.toe.x() - slope.crest.x();
    const auto at = [&](double x) { return earthquake::millimetres(x); };
    const double back = std::min(search["entry"][0].get<double>(), slope.crest.x() - 3.0 * H);
    search["entry"] = {std::max(left, at(back)), at(slope.crest.x() + 0.75 * face)};
    search["exit"][0] = at(slope.crest.x() + 0.25 * face);
    search["minimum_depth"] = at(0.25 * H);
    std::erase_if(document.guessed.get_ref<json::array_t&>(), [](const json& each) {
        return each.at("pointer").get<std::string>().starts_with("/lem/search");
    });
    document.guessed.push_back({{"pointer", "/lem/search"},
                                {"value", search},
                                {"from",
                                 "the ground, as in \"breach new\"; a slip in the face "
                                 "shallower than a quarter of the height is no breach"}});
}

}  // namespace

std::optional<LiquefiedRequest> liquefied_request_from(const std::string& entry,
                                                       std::vector<Fault>& faults) {
    const std::string shown = as_utf8(entry);
    const auto refuse = [&](const std::string& cause) {
        faults.push_back({"liquefied", "\"" + shown + "\" " + cause, std::string("write ") + form});
        return std::nullopt;
    };
    const std::size_t split = shown.find('=');
    if (split == std::string::npos || split == 0) return refuse("names no region with a strength");
    std::string_view rest = std::string_view(shown).substr(split + 1);
    const auto next = [&] {
        const std::size_t comma = rest.find(',');
        const std::string_view word = rest.substr(0, comma);
        rest.remove_prefix(comma == std::string_view::npos ? rest.size() : comma + 1);
        return word;
    };
    LiquefiedRequest request;
    request.region = trimmed(std::string_view(shown).substr(0, split));
    const auto residual = undrained_in(next());
    if (!residual) return refuse("gives no residual strength");
    request.residual = *residual;
    if (const auto peak = undrained_in(rest.substr(0, rest.find(',')))) {
        request.peak = peak;
        next();
    }
    request.source = trimmed(rest);
    if (request.source.empty()) return refuse("names no source of its strength");
    if (!is_sound(request.residual, shown, "residual_ratio", faults) ||
        (request.peak && !is_sound(*request.peak, shown, "peak_ratio", faults)))
        return std::nullopt;
    const Undrained peak = peak_of(request);
    if (peak.in_kPa == request.residual.in_kPa && peak.value < request.residual.value)
        return refuse("has a peak of " + text_of(peak) + ", below the residual strength");
    return request;
}

Healed with_liquefied_parts(std::vector<Soil> soils, const std::vector<LiquefiedRequest>& asked,
                            const std::vector<Vec2>& phreatic, double tolerance) {
    Healed healed{std::move(soils), {}, {}, {}};
    for (const LiquefiedRequest& request : asked) {
        std::vector<std::string> whole;
        for (const Soil& each : healed.soils)
            if (means(request, each) && each.cut_from.empty()) whole.push_back(each.name);
        for (const std::string& each : whole) {
            Healed cut = with_layers(std::move(healed.soils), {each, {}}, phreatic, tolerance);
            healed.soils = std::move(cut.soils);
            std::ranges::move(cut.changes, std::back_inserter(healed.changes));
            std::ranges::move(cut.faults, std::back_inserter(healed.faults));
        }
    }
    return healed;
}

std::vector<Fault> faults_of_liquefying(const std::vector<LiquefiedRequest>& asked,
                                        const std::vector<Soil>& soils, const Lines& lines,
                                        const json& materials) {
    std::vector<Fault> faults;
    if (!has_phreatic(lines, faults)) return faults;
    check_slope(slope_of(ground_of(soils)), "--liquefied", faults);
    for (const LiquefiedRequest& request : asked) {
        const auto is_meant = [&](const Soil& each) { return means(request, each); };
        if (std::ranges::none_of(soils, is_meant))
            faults.push_back({"liquefied", "there is no region \"" + request.region + "\"",
                              "the regions are " + words::list_of(soils, &Soil::name)});
        else if (std::ranges::none_of(soils, [&](const Soil& each) {
                     return is_meant(each) && each.depth_layer > 0;
                 }))
            faults.push_back({"liquefied",
                              request.region + " lies above the phreatic line: it cannot liquefy",
                              "name a region below the line, or check the line's levels"});
    }
    for (const Soil& soil : soils)
        if (soil.depth_layer > 0 &&
            std::ranges::count_if(asked, [&](const auto& each) { return means(each, soil); }) > 1)
            faults.push_back({"liquefied", "region " + soil.name + " has two residual strengths",
                              "give one entry for it"});
    check_drained(soils, materials, faults,
                  [&](const Soil& soil) { return request_of(soil, asked) != nullptr; });
    return faults;
}

void add_liquefaction(const std::vector<LiquefiedRequest>& asked, const std::vector<Soil>& soils,
                      const Lines& lines, Document& document) {
    const json given = document.scene.at("materials");
    const json peaks = take_strengths(asked, soils, document);
    search_all_of(*document.slope, ground_of(soils).front().x(), document);
    // Copies, because the templates' functions need the order of entries.
    earthquake::Json dam = document.scene;
    templates::add_gauges(dam["mpm"], document.slope->toe.x(), document.slope->fall(),
                          dam["mpm"]["domain_x"][1]);
    const std::vector<Vec2> lowered =
        without_pond(lines.phreatic, ground_of(soils), document.slope->crest.x());
    earthquake::Json dry = dam;
    dry["lem"]["water"]["line"] = as_json(lowered);
    for (earthquake::Json* each : {&dam, &dry})
        templates::reduce_friction_of_wet_fill(*each, "_wet");
    json& scene = document.scene = json(dam);
    // The materials as given: a later import of the drawing starts from them.
    for (const auto& [name, material] : given.items())
        if (!scene["materials"].contains(name)) scene["materials"][name] = material;
    scene["title"] = scene.at("name").get<std::string>() + ", liquefied at rest";
    document.study = {{"format", "breachline-study/1"},
                      {"name", scene.at("name")},
                      {"title", scene.at("title")},
                      {"variants", json::array()}};
    const json stands = joined(peaks, templates::overrides_of_standing(dam["materials"]));
    const auto add = [&](const std::string& name, const json& water) {
        for (const auto& [state, strength] :
             {std::pair("liquefied", json::array()), std::pair("undrained_peak", stands)})
            document.study["variants"].push_back(
                {{"name", state + name}, {"overrides", joined(water, strength)}});
    };
    add("", json::array());
    constexpr double least = 0.1;  // m: less is a line that is drawn along the ground
    if (std::ranges::none_of(lowered, [&](const Vec2& each) {
            return geometry::level_at(lines.phreatic, each.x()) - each.y() > least;
        })) {
        document.remarks.push_back(
            "no variants without a pond: the phreatic line is nowhere above the ground behind the "
            "crest");
        return;
    }
    json drained{assigned("/lem/water/line", as_json(lowered))};
    for (std::size_t i = 0; i < soils.size(); ++i) {
        const auto material_in = [&](const earthquake::Json& of) {
            return of.at("section").at("regions")[i].at("material").get<std::string>();
        };
        const std::string name = material_in(dam);
        const json law = dry.at("materials").at(material_in(dry)).at("law");
        if (law != scene["materials"][name]["law"])
            drained.push_back(assigned("/materials/" + name + "/law", law));
    }
    add("_no_pond", drained);
}

}  // namespace breach::importing
