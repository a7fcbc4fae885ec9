// Adds what a FEM with an earthquake needs to an imported section, or says why it cannot: a slope
// to the right, a phreatic line, layers that can liquefy, a level base and upright sides. The
// checks come before any mesh, with places on the drawing.
#include "services/import/shake.hpp"

#include <algorithm>
#include <set>

#include "core/words/list.hpp"
#include "core/words/number.hpp"

namespace breach::importing {

using nlohmann::json;

namespace {

/// document.cpp rounds to a micrometre.
constexpr double same_place = 1e-6;  // m: rounding of a scene's vertices

/// PM4Sand replaces frictional soil that drains; undrained strengths stay as they are.
bool is_drained(const json& material) {
    const json& law = material.at("law");
    return law.at("type") == "mohr_coulomb" && !material.contains("strength") &&
           law.value("phi_deg", 0.0) > 0.0;
}

bool is_upright(const std::vector<Soil>& soils, double x) {
    return geometry::upright_at(outlines_of(soils), x, same_place).unbroken;
}

// ------------------------------------------------------------ what the FEM cannot do

/// Only layers can liquefy, so that a section without any would shake for nothing.
void check_layers(const std::vector<Soil>& soils, const Lines& lines, const json& materials,
                  std::vector<Fault>& faults) {
    if (!has_phreatic(lines, faults)) return;
    if (std::ranges::none_of(soils, [](const Soil& each) { return each.depth_layer > 0; }))
        faults.push_back(
            {"layers", "no region is cut in layers below the phreatic line, so none can liquefy",
             "name the tailings and depths, as --layers REGION=5,10; the regions are " +
                 words::list_of(soils, &Soil::name)});
    check_drained(soils, materials, faults, [&](const Soil& each) {
        return each.depth_layer > 0 &&
               materials.at(each.material).at("law").at("type") != "pm4sand";
    });
}

/// The lower edge must be level, like the rock below it.
void check_base(const std::vector<Soil>& soils, std::vector<Fault>& faults) {
    const geometry::Outlines outlines = outlines_of(soils);
    const std::vector<double> xs = geometry::abscissae(outlines);
    const double low = box_of(soils).low.y();
    double most = same_place;
    Vec2 at = Vec2::Zero();
    std::size_t region = 0;
    for (std::size_t i = 0; i + 1 < xs.size(); ++i) {
        const double x = 0.5 * (xs[i] + xs[i + 1]);
        const auto strata = geometry::strata_at(outlines, x);
        if (strata.empty() || strata.back().bottom - low <= most) continue;
        most = strata.back().bottom - low;
        at = {x, strata.back().bottom};
        region = strata.back().region;
    }
    if (most <= same_place) return;
    const Vec2 base(at.x(), low);
    faults.push_back({at_line(soils[region].origin.line),
                      "the lower edge is not level: " + soils[region].name + " ends at " +
                          text(at) + ", " + metres(most) + " above the lowest level",
                      "the FEM's base is level: draw the ground down to " + text(base) +
                          " there, and so along the whole section"});
}

/// Each side is one vertical line, for a free-field column, or the ground falls to the base.
void check_side(const std::vector<Soil>& soils, double x, const std::string& side,
                std::vector<Fault>& faults) {
    const geometry::Upright reach = geometry::upright_at(outlines_of(soils), x, same_place);
    const double low = box_of(soils).low.y();
    if (reach.unbroken || reach.high <= low + same_place) return;
    faults.push_back({"drawing",
                      "the " + side + " side is not vertical: the section ends at " +
                          text(Vec2(x, reach.high)) + ", above its base at y = " + metres(low),
                      "end the section at x = " + metres(x) +
                          " in a vertical side from the ground to the base"});
}

// ------------------------------------------------------------ materials

/// All materials of the scene, and which become another one in the runout.
struct Completed {
    json materials;
    std::map<std::string, std::string> runouts;
};

/// The assumed soil of "breach new" that resembles this one, and why.
std::pair<earthquake::Soil, std::string> like(const std::string& material,
                                              const std::vector<Soil>& soils, const json& scene) {
    const json& runout = scene.at("mpm").at("runout");
    const auto is_mobile = [&](const Soil& each) {
        return !runout.contains("regions") ||
               std::ranges::find(runout.at("regions"), json(each.name)) !=
                   runout.at("regions").end();
    };
    bool layered = false, mobile = false;
    for (const Soil& each : soils) {
        if (each.material != material) continue;
        layered = layered || each.depth_layer > 0;
        mobile = mobile || is_mobile(each);
    }
    if (layered)
        return {earthquake::tailings, "tailings of \"breach new\": its layers can liquefy"};
    if (!is_drained(scene.at("materials").at(material)) && mobile)
        return {earthquake::clay, "clay of \"breach new\": it is not drained"};
    if (mobile) return {earthquake::embankment, "embankment of \"breach new\""};
    return {earthquake::foundation, "foundation of \"breach new\": it lies below the toe"};
}

/// What the user gives replaces what "breach new" assumes for such a soil.
/// c and phi of a PM4Sand material are in limit_strength, as that law has none.
earthquake::Soil with_given(earthquake::Soil soil, const json& own) {
    const json& law = own.at("law");
    const json strength = own.value("limit_strength", law);
    soil.density = own.at("density");
    soil.c_kPa = strength.value("c_kPa", soil.c_kPa);
    soil.phi_deg = strength.value("phi_deg", soil.phi_deg);
    soil.E_MPa = law.value("E_MPa", soil.E_MPa);
    return soil;
}

/// Drained soil NAME becomes PM4Sand, and NAME_runout in the runout with the given values. PM4Sand
/// is unchanged.
Completed completed(const std::vector<Soil>& soils, Document& document) {
    Completed all{document.scene.at("materials"), {}};
    std::set<std::string> names;
    for (const Soil& each : soils) names.insert(each.material);
    for (const std::string& name : names) {
        const json own = all.materials.at(name);
        const auto [soil, why] = like(name, soils, document.scene);
        const std::string runout = name + "_runout";
        json made = own;
        if (is_drained(own)) {
            made = earthquake::sand(with_given(soil, own), "density and drained strength as given");
            for (const char* entry : {"void_ratio", "permeability", "limit_strength"})
                if (own.contains(entry)) made[entry] = own.at(entry);
            if (!all.materials.contains(runout)) all.materials[runout] = own;
        }
        if (!made.contains("void_ratio")) made["void_ratio"] = soil.void_ratio;
        if (!made.contains("permeability"))
            made["permeability"] = {soil.permeability, soil.permeability};
        if (all.materials.contains(runout)) all.runouts[name] = runout;
        if (made == own) continue;
        document.guessed.push_back({{"pointer", "/materials/" + name},
                                    {"value", made.at("law").at("type")},
                                    {"from", why}});
        all.materials[name] = std::move(made);
    }
    return all;
}

/// Moves the wall of the runout away from the soil, which has swayed.
void make_room(double left, Document& document) {
    json& mpm = document.scene["mpm"];
    const double h = mpm.at("cell_size"), wall = earthquake::wall_beside(left, h);
    json& x = mpm["domain_x"];
    if (x[0].get<double>() <= wall) return;
    x = {wall, x[1].get<double>() + h - (x[0].get<double>() - wall)};
    mpm["floor"]["friction"][0]["from"] = x[0];
    mpm["floor"]["friction"][0]["to"] = x[1];
    for (json& each : document.guessed)
        if (each.at("pointer") == "/mpm/domain_x") each["value"] = x;
}

}  // namespace

void check_slope(const std::optional<Slope>& slope, const std::string& option,
                 std::vector<Fault>& faults) {
    if (!slope)
        faults.push_back({"drawing", "the ground has no slope that could fail",
                          "draw the dam's face, or leave " + option + " out"});
    else if (slope->toe.x() < slope->crest.x())
        faults.push_back({"drawing",
                          "the slope falls to the left, from its crest " + text(slope->crest) +
                              " to its toe " + text(slope->toe) +
                              ": a runout is measured to the right",
                          "mirror the drawing: give -x for x"});
}

bool has_phreatic(const Lines& lines, std::vector<Fault>& faults) {
    if (!lines.phreatic.empty()) return true;
    faults.push_back({"phreatic", "is missing: soil below the phreatic line can liquefy",
                      "draw it on a layer PHREATIC, or give it as a file"});
    return false;
}

void check_drained(const std::vector<Soil>& soils, const json& materials,
                   std::vector<Fault>& faults, const std::function<bool(const Soil&)>& liquefies) {
    std::set<std::string> reported;
    for (const Soil& each : soils) {
        if (!liquefies(each) || is_drained(materials.at(each.material)) ||
            !reported.insert(each.material).second)
            continue;
        faults.push_back({"/materials/" + each.material,
                          "is not drained soil, and region " + each.name + " is to liquefy",
                          "give a mohr_coulomb law with its drained c_kPa and phi_deg above 0; "
                          "liquefied soil gets its residual strength beside it"});
    }
}

std::vector<Change> straightened(std::vector<Soil>& soils, double tolerance) {
    std::vector<Change> changes;
    if (soils.empty()) return changes;
    const geometry::Box box = box_of(soils);
    for (Soil& each : soils) {
        for (Vec2& place : each.ring) {
            Vec2 moved = place;
            if (place.y() <= box.low.y() + tolerance) moved.y() = box.low.y();
            if (place.x() <= box.low.x() + tolerance) moved.x() = box.low.x();
            if (place.x() >= box.high.x() - tolerance) moved.x() = box.high.x();
            const double off = (moved - place).norm();
            if (off > 0.0) changes.push_back({"edge", {each.name}, moved, off});
            place = moved;
        }
    }
    return changes;
}

std::vector<Fault> faults_of_shaking(const std::vector<Soil>& soils, const Lines& lines,
                                     const json& materials) {
    std::vector<Fault> faults;
    check_slope(slope_of(ground_of(soils)), "--with-fem", faults);
    check_layers(soils, lines, materials, faults);
    check_base(soils, faults);
    check_side(soils, box_of(soils).low.x(), "left", faults);
    check_side(soils, box_of(soils).high.x(), "right", faults);
    return faults;
}

void add_earthquake(const Earthquake& asked, const std::vector<Soil>& soils, const Lines& lines,
                    Document& document) {
    json& scene = document.scene;
    Completed completed = importing::completed(soils, document);
    const geometry::Box box = box_of(soils);
    const json low = as_json(box.low), high = as_json(box.high);  // like the scene's vertices
    const auto wet = std::ranges::find_if(soils, [](const Soil& s) { return s.depth_layer > 0; });
    const std::string soil = wet->material;
    earthquake::Section section{.regions = {},
                                .runouts = completed.runouts,
                                .phreatic = lines.phreatic,
                                .crest = document.slope->crest,
                                .crest_from = document.slope->crest.x(),
                                .height = document.slope->fall(),
                                .left = low[0],
                                .right = high[0],
                                .base = low[1],
                                .upright_left = is_upright(soils, box.low.x()),
                                .upright_right = is_upright(soils, box.high.x()),
                                .element_size = scene.at("section").at("element_size"),
                                .cell_size = scene.at("mpm").at("cell_size"),
                                .layer_thickness = asked.layer_thickness,
                                .largest_sigma_v0_kPa = 0.0,
                                .density = completed.materials.at(soil).at("density")};
    const std::vector<Vec2> ground = ground_of(soils);
    const earthquake::Overburden above{ground, lines.phreatic, section.density};
    for (const Soil& each : soils) {
        section.regions.push_back({each.name, each.material, each.ring, each.depth_layer});
        if (each.depth_layer > 0)
            section.largest_sigma_v0_kPa = std::max(section.largest_sigma_v0_kPa,
                                                    earthquake::largest_sigma_v0(each.ring, above));
    }
    if (!completed.materials.contains("liquefied")) {
        const std::string given = completed.runouts.contains(soil) ? soil + "_runout" : soil;
        completed.materials["liquefied"] =
            earthquake::liquefied(with_given(earthquake::tailings, completed.materials.at(given)),
                                  section.residual_ratio);
    }
    scene["materials"] = std::move(completed.materials);
    scene["lem"]["liquefaction"] = *earthquake::liquefaction_of(section);
    scene["fem"] = earthquake::fem_of(section, asked.motion);
    scene["transfer"] = earthquake::transfer_of(section);
    // After a FEM the runout starts from the stresses of the transfer.
    scene["mpm"].erase("fill_stress");
    make_room(box.low.x(), document);
    const auto guess = [&](const std::string& pointer, const std::string& from) {
        document.guessed.push_back({{"pointer", pointer},
                                    {"value", scene.at(json::json_pointer(pointer))},
                                    {"from", from}});
    };
    guess("/fem/motion/file", "a synthetic motion; replace it with a record of the site");
    guess("/fem/base/V_s", "rock below the section");
    guess("/transfer/liquefied/residual_strength/coefficient_kPa",
          "a residual strength of " + words::text_of(section.residual_ratio) +
              " sigma'_v0, as in \"breach new\"");
    for (const auto& [upright, side] :
         {std::pair(section.upright_left, "left"), std::pair(section.upright_right, "right")})
        if (!upright)
            document.remarks.push_back(std::string("no free-field column on the ") + side +
                                       ": the ground comes down to the base there");
}

}  // namespace breach::importing
