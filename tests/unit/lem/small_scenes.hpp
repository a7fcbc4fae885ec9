// Sections small enough to check by hand.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/scene/scene.hpp"
#include "lem_tool/search.hpp"
#include "lem_tool/slip_circle.hpp"

namespace breach::lem::small {

using nlohmann::json;
using Ring = std::vector<std::vector<double>>;

inline json soil(double gamma_kN, double c_kPa, double phi_deg) {
    return {{"density", gamma_kN * 100.0},
            {"law",
             {{"type", "mohr_coulomb"},
              {"E_MPa", 10},
              {"nu", 0.3},
              {"c_kPa", c_kPa},
              {"phi_deg", phi_deg}}}};
}

inline json rock(double gamma_kN) {
    return {{"density", gamma_kN * 100.0},
            {"law", {{"type", "linear_elastic"}, {"E_MPa", 100}, {"nu", 0.3}}}};
}

inline json region(const std::string& name, const std::string& material, Ring ring) {
    ring.push_back(ring.front());
    return {{"name", name}, {"material", material}, {"polygon", ring}};
}

/// A scene with g = 10, so that a density of 100 is a unit weight of 1 kN/m3.
inline json scene(const json& materials, const json& regions, const json& lem) {
    return {{"format", "breachline-scene/1"},
            {"name", "small"},
            {"gravity", 10.0},
            {"materials", materials},
            {"section", {{"regions", regions}}},
            {"lem", lem}};
}

inline scene::Scene parsed(const json& text) { return scene::parse_scene(text.dump(), "small"); }

/// A 2:1 slope, 10 m high, facing right: crest at x = 20, toe at x = 40, base at -5, two layers.
inline json two_layers(const json& lem) {
    return scene({{"fill", soil(20, 8, 25)}, {"base", soil(18, 15, 20)}},
                 json::array({region("base", "base", {{0, -5}, {60, -5}, {60, 0}, {0, 0}}),
                              region("fill", "fill", {{0, 0}, {40, 0}, {20, 10}, {0, 10}})}),
                 lem);
}

inline json some_circle() { return {{"circle", {{"center", {33, 18}}, {"radius", 20}}}}; }
inline json some_search() {
    return {{"search",
             {{"entry", {2, 19}},
              {"exit", {30, 55}},
              {"entry_points", 12},
              {"exit_points", 12},
              {"depths", 12}}}};
}

inline Bishop circle_bishop(const scene::Scene& scene) {
    const Model model = make_model(scene);
    Slices slices = make_slices(model.strata, model.slices);
    const auto masses = masses_of(model.strata, *scene.lem->circle);
    if (masses.size() != 1) return {Balance::not_converged, -1.0, 0.0, 0};
    if (cut(model.strata, model.soils, masses[0], model.slices, slices) != Cut::done) {
        return {Balance::not_converged, -2.0, 0.0, 0};
    }
    return bishop(slices, slide_of(slices), model.k_h);
}

}  // namespace breach::lem::small
