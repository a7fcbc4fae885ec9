// From an outline to a whole scene, the same for all templates. A template decides shapes and
// water; here every soil gets a material, every layer below the water a residual strength, and
// every phase its part. What was not given by the user is a note "assumed" in the scene, because
// the author must find it again.
//
// Two kinds of scene: at rest, with the layers liquefied from the start (LEM and runout), or
// shaken, where the FEM finds what liquefies (with_fem).
#include "services/templates/assembly.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "core/geometry/polyline.hpp"
#include "core/scene/resolution.hpp"
#include "core/words/number.hpp"
#include "services/earthquake/earthquake.hpp"
#include "services/templates/layers.hpp"
#include "services/templates/wet_fill.hpp"

namespace breach::templates {

using earthquake::atmosphere, earthquake::g;
using earthquake::clay, earthquake::embankment, earthquake::foundation, earthquake::tailings;
using earthquake::corner, earthquake::millimetres, earthquake::nanometres, earthquake::points,
    earthquake::rounded;
using earthquake::frictional, earthquake::sand, earthquake::undrained;
using earthquake::Json, earthquake::Overburden, earthquake::Region, earthquake::Soil;

namespace {

/// For soil that stays: a few per cent of critical damping, else it would oscillate for minutes.
constexpr double damping = 3e4;  // Pa s

const Soil loose_soil{"soil", 1850, 0.85, 1e-6, 0.35, 476, 2.7, 2, 34, 2, 34, 20, 0.3};
/// slimes_ratio and residual_ratio give the strength.
const Soil slimes{"slimes", 1700, 1.4, 1e-9, 0, 0, 0, 0, 28, 0, 0, 10, 0.49};
const Soil rockfill{"rockfill", 2100, 0.4, 1e-3, 0.75, 890, 0.63, 0, 42, 0, 42, 80, 0.3};

// ---------------------------------------------------------------- the section

std::string name_of(const std::string& whole, int layer, int piece) {
    const std::string number = layer > 0 ? "_" + std::to_string(layer) : "";
    return whole + (piece > 0 && layer == 0 ? "_0" : number) +
           (piece > 0 ? "_" + std::to_string(piece + 1) : "");
}

/// The level base of the foundation, foundation_depth below the lowest ground.
double base_of(const Values& values) {
    return std::min(0.0, Terrain(values).at(values["foundation_extent"])) -
           values["foundation_depth"];
}

/// share_vertices() makes neighbours meet in common vertices, as the mesh needs; stresses come
/// last, because they are means over the finished layers.
std::vector<Region> regions_of(const Values& values, const Outline& outline, const Soil& wet) {
    std::vector<Part> parts;
    std::vector<int> layers;
    if (values["foundation_depth"] > 0.0) {
        const double right = values["foundation_extent"];
        const Terrain terrain(values);
        // From right to left, at this depth below the ground.
        // A line parallel to the ground, from right to left: the upper side of a ring that runs
        // counter-clockwise.
        const auto below_ground = [&](double depth) {
            Line line{{right, terrain.at(right) - depth}};
            // The ground has its kink at the toe.
            if (!terrain.is_level()) line.push_back({0.0, -depth});
            line.push_back({outline.left, terrain.at(outline.left) - depth});
            return line;
        };
        const auto stratum = [&](const std::string& soil, Line bottom, double depth_of_top) {
            const Line top = below_ground(depth_of_top);
            bottom.insert(bottom.end(), top.begin(), top.end());
            parts.push_back({soil, soil, bottom});
            layers.push_back(0);
        };
        const double clay = values["clay_thickness"], bottom = base_of(values);
        stratum("foundation", {{outline.left, bottom}, {right, bottom}}, clay);
        if (clay > 0.0) {
            Line base = below_ground(clay);
            std::ranges::reverse(base);
            stratum("clay", base, 0.0);
        }
    }
    for (const Part& part : outline.parts) {
        if (part.name != outline.wet) {
            parts.push_back(part);
            layers.push_back(0);
            continue;
        }
        // Thin pieces are joined to others: the reader of scenes refuses cells too coarse for the
        // thinnest part (check_made in templates.cpp).
        const Cut cut{values["layer_thickness"],
                      std::min(0.25 * values["cell_size"], 0.1 * values["layer_thickness"]),
                      2.2 * values["cell_size"]};
        int piece = 0, number = -1;
        for (const Layer& layer : cut_by_depth(part.polygon, outline.phreatic, cut)) {
            piece = layer.number == number ? piece + 1 : 0;
            number = layer.number;
            parts.push_back({name_of(part.name, number, piece), part.material, layer.polygon});
            layers.push_back(number);
        }
    }
    share_vertices(parts);
    std::vector<Region> regions;
    for (std::size_t i = 0; i < parts.size(); ++i)
        regions.push_back({parts[i].name, parts[i].material, parts[i].polygon, layers[i]});
    find_stresses(regions, {outline.ground, outline.phreatic, wet.density},
                  outline.crest_from - outline.crest.y());
    return regions;
}

// ---------------------------------------------------------------- materials

Json elastic_ground() {
    return {
        {"notes",
         {"assumed: ground that does not move; E = 200 MPa; its strength counts in the limit "
          "equilibrium only"}},
        {"density", foundation.density},
        {"limit_strength", {{"c_kPa", foundation.c_kPa}, {"phi_deg", foundation.phi_deg}}},
        {"law", {{"type", "linear_elastic"}, {"E_MPa", foundation.E_MPa}, {"nu", foundation.nu}}}};
}

std::string strength_note(const Soil& soil) {
    return "assumed: drained strength c' = " + words::text_of(soil.c_kPa) +
           " kPa, phi' = " + words::text_of(soil.phi_deg) + " deg, density " +
           words::text_of(soil.density) + " kg/m3";
}

std::string breaking_note(const Soil& soil) {
    return "assumed: breaks within 1 to 5 % of shear strain to c' = " +
           words::text_of(soil.c_residual_kPa) +
           " kPa, phi' = " + words::text_of(soil.phi_residual_deg) + " deg";
}

/// What every part of the scene is made from; lives as long as scene_of().
struct Context {
    const Values& values;
    const Outline& outline;
    const Soil& wet;
    std::vector<Region> regions;
    bool with_fem;
    double unit;  ///< sqrt(H / g), the unit of times [s]
};

bool has(const Context& all, const std::string& material) {
    return std::ranges::any_of(all.regions,
                               [&](const Region& each) { return each.material == material; });
}

std::vector<Region> layers_of(const Context& all) {
    std::vector<Region> layers;
    for (const Region& each : all.regions)
        if (each.layer > 0) layers.push_back(each);
    return layers;
}

double residual_kPa(const Context& all, const Region& layer) {
    return rounded(all.values["residual_ratio"] * layer.sigma_v0_kPa);
}

/// Without a FEM, each layer below the phreatic line has its own material of constant strength.
/// With a FEM the transfer decides what has liquefied, so the layers share one material.
std::string material_of(const Context& all, const Region& region) {
    const bool liquefied = region.layer > 0 && !all.with_fem;
    return region.material + (liquefied ? "_" + std::to_string(region.layer) : "");
}

/// The same in every phase: undrained, with the strength that the option gives.
Json weak_layer(const Context& all) {
    const double s_u = all.values["clay_strength"];
    Json material = undrained(clay, s_u,
                              "weak layer below the dam, undrained: s_u from clay_strength; void "
                              "ratio and permeability assumed");
    material["limit_strength"] = {{"c_kPa", s_u}, {"phi_deg", 0}};
    material["void_ratio"] = clay.void_ratio;
    material["permeability"] = {clay.permeability, clay.permeability};
    return material;
}

/// Phases that support profiles get the strength by stress; the FEM gets its mean.
/// In elements: one strength per region, because the FEM has no profiles. It is the mean over the
/// whole region by area.
Json slimes_of(const Context& all, bool in_elements) {
    Json material{
        {"notes",
         {"assumed: slimes of density 1700 kg/m3, undrained: slimes_ratio sigma'_v0, softening to "
          "residual_ratio sigma'_v0"}},
        {"density", slimes.density},
        {"viscosity", 1000},
        {"void_ratio", slimes.void_ratio},
        {"permeability", {slimes.permeability, slimes.permeability}}};
    const auto share = [&](const char* option) {
        return Json{{"type", "undrained_ratio"}, {"ratio", all.values[option]}, {"minimum_kPa", 1}};
    };
    material["law"] = {{"type", "mohr_coulomb"}, {"E_MPa", slimes.E_MPa}, {"nu", slimes.nu}};
    if (in_elements) {
        earthquake::Sum sum;
        const Overburden above{all.outline.ground, all.outline.phreatic, slimes.density};
        for (const Region& each : all.regions)
            if (each.name == "slimes") add(sum, each.polygon, above, all.outline.left);
        material["law"]["c_kPa"] = rounded(all.values["slimes_ratio"] * sum.stress_area / sum.area);
        material["law"]["phi_deg"] = 0;
        return material;
    }
    material["strength"] = {{"peak", share("slimes_ratio")},
                            {"residual", share("residual_ratio")},
                            {"softening", {{"epsilon_q_start", 0.02}, {"epsilon_q_end", 0.2}}}};
    return material;
}

/// Dry soil keeps its drained strength; only layers below the line are weakened.
Json materials_at_rest(const Context& all) {
    Json materials;
    if (has(all, "clay")) materials["clay"] = weak_layer(all);
    if (has(all, "slimes")) materials["slimes"] = slimes_of(all, false);
    if (has(all, "rockfill")) materials["rockfill"] = frictional(rockfill, strength_note(rockfill));
    if (has(all, "embankment")) {
        materials["embankment"] = frictional(embankment, strength_note(embankment));
        materials["embankment"]["notes"].push_back(breaking_note(embankment));
    }
    materials[all.wet.name] = frictional(all.wet, strength_note(all.wet));
    for (const Region& each : layers_of(all))
        materials[material_of(all, each)] =
            undrained(all.wet, residual_kPa(all, each),
                      "assumed: liquefied, s_r = " + words::text_of(all.values["residual_ratio"]) +
                          " sigma'_v0, of which the mean from a height behind the crest on is " +
                          words::text_of(rounded(each.sigma_v0_kPa)) +
                          " kPa; limit_strength is drained, before it liquefies");
    if (has(all, "foundation")) materials["foundation"] = elastic_ground();
    return materials;
}

/// Each soil twice: for the FEM a law that can liquefy, for the runout one that can flow far.
Json materials_shaken(const Context& all) {
    Json materials;
    const auto both = [&](const Soil& soil) {
        materials[soil.name] = sand(soil, strength_note(soil));
        materials[soil.name + "_runout"] =
            frictional(soil, "of " + soil.name + " in the runout, drained; " + strength_note(soil));
        // Of these soils only the embankment's fill has a lower strength once it has broken.
        if (soil.c_residual_kPa != soil.c_kPa)
            materials[soil.name + "_runout"]["notes"].push_back(breaking_note(soil));
    };
    if (has(all, "clay")) materials["clay"] = materials["clay_runout"] = weak_layer(all);
    if (has(all, "slimes")) {
        materials["slimes"] = slimes_of(all, true);
        materials["slimes_runout"] = slimes_of(all, false);
    }
    if (has(all, "rockfill")) both(rockfill);
    if (has(all, "embankment")) both(embankment);
    both(all.wet);
    if (!layers_of(all).empty())
        materials["liquefied"] = earthquake::liquefied(all.wet, all.values["residual_ratio"]);
    if (has(all, "foundation")) {
        materials["foundation"] = sand(foundation, strength_note(foundation));
        materials["foundation_runout"] = elastic_ground();
    }
    return materials;
}

// ---------------------------------------------------------------- phases

Json section_of(const Context& all) {
    Json regions = Json::array();
    for (const Region& each : all.regions) {
        Json ring = Json::array();
        for (const Vec2& vertex : each.polygon) ring.push_back(corner(vertex));
        ring.push_back(ring.front());
        regions.push_back(
            {{"name", each.name}, {"material", material_of(all, each)}, {"polygon", ring}});
        if (all.with_fem) regions.back()["mesh"] = {{"type", "unstructured"}};
    }
    Json section;
    if (all.with_fem) section["element_size"] = all.values["element_size"];
    section["regions"] = regions;
    return section;
}

/// The same section in the terms of services/earthquake, which imported sections use as well.
earthquake::Section shaken_of(const Context& all) {
    const Values& values = all.values;
    std::map<std::string, std::string> runouts;
    const Overburden above{all.outline.ground, all.outline.phreatic, all.wet.density};
    double largest = 0.0;
    for (const Region& each : all.regions) {
        // Named as materials_shaken() names them.
        runouts[each.material] = each.material + "_runout";
        if (each.layer > 0)
            largest = std::max(largest, earthquake::largest_sigma_v0(each.polygon, above));
    }
    return {.regions = all.regions,
            .runouts = runouts,
            .phreatic = all.outline.phreatic,
            .crest = all.outline.crest,
            .crest_from = all.outline.crest_from,
            .height = values["height"],
            .left = all.outline.left,
            .right = values["foundation_extent"],
            .base = base_of(values),
            .element_size = values["element_size"],
            .cell_size = values["cell_size"],
            .layer_thickness = values["layer_thickness"],
            .largest_sigma_v0_kPa = largest,
            .density = all.wet.density,
            .residual_ratio = values["residual_ratio"]};
}

/// The search enters behind the crest and leaves near the toe; with a foundation also beyond it.
Json stability_of(const Context& all) {
    const Outline& outline = all.outline;
    const double H = all.values["height"],
                 back = std::max(outline.left, outline.crest_from - 3.0 * H);
    const double beyond = std::min(0.5 * H, 0.9 * all.values["foundation_extent"]);
    const double face = -outline.crest.x();
    Json lem{
        {"notes",
         {"surfaces less deep than a quarter of the height are left out: a slip in the face is no "
          "breach",
          all.values.or_none("piezometer_depth") > 0.0
              ? "phreatic line: straight from the pond through the piezometer to its exit"
              : "phreatic line: Dupuit's parabola from the pond (assumed: steady flow over a tight "
                "base)",
          all.with_fem ? "residual strengths: residual_ratio times sigma'_v0 of every slice"
                       : "residual strengths: those of the layers in the runout"}}};
    lem["search"] = {{"entry", {millimetres(back), millimetres(outline.crest.x() + 0.75 * face)}},
                     {"exit",
                      {millimetres(outline.crest.x() + 0.25 * face),
                       millimetres(has(all, "foundation") ? beyond : 0.0)}},
                     {"minimum_depth", millimetres(0.25 * H)}};
    lem["water"] = {{"line", points(outline.phreatic)}};
    if (all.with_fem) {
        // By stress: with a FEM the layers have no strength of their own.
        if (const auto layers = liquefaction_of(shaken_of(all))) lem["liquefaction"] = *layers;
        return lem;
    }
    for (const Region& each : layers_of(all))
        lem["liquefaction"].push_back(
            {{"region", each.name}, {"residual_strength_kPa", residual_kPa(all, each)}});
    return lem;
}

/// Grid lines coincide with the model's left end and its floor.
Json runout_of(const Context& all) {
    const Values& values = all.values;
    const double h = values["cell_size"], H = values["height"], depth = values["foundation_depth"];
    const Terrain terrain(values);
    const double from = nanometres(all.outline.left);
    // At rest nothing sways: the wall is the model's end.
    const double left = all.with_fem ? earthquake::wall_beside(from, h) : from;
    const double columns = std::ceil((values["runout_extent"] - left) / h);
    const double lowest =
        std::min(depth > 0.0 ? base_of(values) : 0.0, terrain.at(left + columns * h));
    // The floor lies at least a cell below the lowest ground.
    const double below = lowest < 0.0 ? std::ceil((h - lowest) / h) : 0.0;
    const double above = std::ceil(1.15 * H / h);
    const double right = left + columns * h, floor = -below * h;
    Json mpm{{"notes",
              {"cells are for a first look (2 to 3 across a layer): halve cell_size before relying "
               "on the runout",
               "assumed: friction of 0.5 between soil and terrain; soil sticks to the modelled "
               "foundation"}}};
    mpm["cell_size"] = h;
    mpm["domain_x"] = {left, right};
    mpm["domain_y"] = {floor, above * h};
    const double end = depth > 0.0 ? nanometres(values["foundation_extent"]) : 0.0;
    mpm["floor"] = {{"level", floor},
                    {"friction", {{{"from", left}, {"to", right}, {"coefficient", 0.5}}}}};
    if (depth > 0.0)
        for (const Vec2& each : earthquake::terrain_of(left, base_of(values), end, right, h,
                                                       [&](double x) { return terrain.at(x); }))
            mpm["terrain"].push_back(corner(each));
    else if (!terrain.is_level())
        mpm["terrain"] = {{left - h, nanometres(terrain.at(left - h))},
                          {0.0, 0.0},
                          {right, nanometres(terrain.at(right))}};
    if (values.or_none("pond_depth") > 0.0) mpm["water"] = {{"line", points(all.outline.phreatic)}};
    mpm["fill_points"] = scene::points_across_cell;
    if (!all.with_fem) mpm["fill_stress"] = "overburden";
    mpm["overlap_correction"] = {{"rate", scene::usual_overlap_rate}};
    mpm["softening_length"] = rounded(H / 15.0);
    mpm["duration"] = "until_rest";
    // Twice the likely duration of a flow without friction (75 sqrt(H / g) in services/estimate).
    mpm["longest_duration"] = rounded(150.0 * all.unit);
    mpm["snapshot_interval"] = rounded(all.unit);
    mpm["telemetry_interval"] = rounded(0.15 * all.unit);
    Json mobile = Json::array();
    for (const Region& each : all.regions)
        // Foundation and clay lie beyond the toe from the start: they must not count as runout.
        if (each.material != "foundation" && each.material != "clay") mobile.push_back(each.name);
    mpm["runout"] = {{"toe", {0, 0}}, {"regions", mobile}};
    add_gauges(mpm, 0.0, H, right);
    return mpm;
}

}  // namespace

void add_gauges(Json& mpm, double toe, double height, double right) {
    mpm["gauges"] = {{{"name", "toe"}, {"x", toe}}};
    for (const auto& [name, heights] :
         {std::pair("one_height", 1.0), std::pair("three_heights", 3.0)})
        if (const double x = toe + heights * height; x < right)
            mpm["gauges"].push_back({{"name", name}, {"x", x}});
    mpm["sections"] = {{{"name", "toe"}, {"x", toe}}};
}

Json overrides_of_standing(const Json& materials) {
    Json overrides = Json::array();
    // Only in the variant that stands and would sway: a flow must not be damped.
    for (const auto& [name, material] : materials.items())
        overrides.push_back("/materials/" + name + "/viscosity=" + words::text_of(damping));
    // A stable dam releases hardly any energy to compare its oscillation with.
    overrides.push_back("/mpm/rest_kinetic_share=0.05");
    overrides.push_back("/mpm/rest_speed=0.2");
    return overrides;
}

earthquake::Motion motion_in(const Values& values) { return {values["pga"], values["shaking"]}; }

Json scene_of(const Values& values, const Outline& outline, const std::string& name) {
    const Soil& wet = outline.wet == "tailings" ? tailings : loose_soil;
    const Context all{values,
                      outline,
                      wet,
                      regions_of(values, outline, wet),
                      values.is_on("with_fem"),
                      std::sqrt(values["height"] / g)};
    Json scene{{"format", "breachline-scene/1"}, {"name", name}};
    scene["title"] = values.of().title + ", " + metres(values["height"]) + " high" +
                     (all.with_fem ? ", shaken" : ", liquefied at rest");
    scene["notes"] = {
        "made by: breach new " + values.of().name + "; the toe lies at (0, 0), x points downstream",
        "replace the values marked as assumed by those of your site"};
    scene["materials"] = all.with_fem ? materials_shaken(all) : materials_at_rest(all);
    for (Json& material : scene["materials"])
        if (material.at("law").contains("softening") || material.contains("strength"))
            // Softening needs a length, or its bands get as thin as the cells and the result
            // follows the grid.
            material["nonlocal_length"] = 2.0 * values["cell_size"];
    scene["section"] = section_of(all);
    scene["lem"] = stability_of(all);
    if (all.with_fem) {
        const earthquake::Section shaken = shaken_of(all);
        scene["fem"] = fem_of(shaken, motion_in(values));
        scene["transfer"] = transfer_of(shaken);
    }
    scene["mpm"] = runout_of(all);
    // Last: it reads the finished scene.
    reduce_friction_of_wet_fill(scene);
    return scene;
}

/// At rest the study has two variants of one scene: all layers liquefied, and the same with the
/// undrained strength before liquefaction. If the second one stands, the first shows what
/// liquefaction adds.
Json study_of(const Values& values, const Json& scene) {
    Json study{{"format", "breachline-study/1"},
               {"name", scene.at("name")},
               {"title", scene.at("title")},
               {"scene", "scene.json"}};
    if (values.is_on("with_fem")) {
        study.update(transfers_of(motion_in(values)));
        return study;
    }
    Json overrides = Json::array(), undrained_regions = Json::array();
    for (const Json& each : scene.at("section").at("regions")) {
        const std::string material = each.at("material");
        const Json& law = scene.at("materials").at(material).at("law");
        // Liquefied layers are the materials without friction; clay is weak in both variants.
        if (law.value("phi_deg", 1.0) != 0.0 || material == "clay") continue;
        const double peak = rounded(law.at("c_kPa").get<double>() * values["peak_ratio"] /
                                    values["residual_ratio"]);
        const std::string override =
            "/materials/" + material + "/law/c_kPa=" + words::text_of(peak);
        // Pieces of one layer share their material.
        if (std::ranges::find(overrides, Json(override)) == overrides.end())
            overrides.push_back(override);
        undrained_regions.push_back({{"region", each.at("name")}, {"strength_kPa", peak}});
    }
    if (overrides.empty()) return study;
    for (Json& each : overrides_of_standing(scene.at("materials")))
        overrides.push_back(std::move(each));
    overrides.push_back("/lem/undrained=" + undrained_regions.dump());
    study["variants"] = {{{"name", "liquefied"}},
                         {{"name", "undrained_peak"}, {"overrides", overrides}}};
    return study;
}

}  // namespace breach::templates
