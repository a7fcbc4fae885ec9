// A published problem (tests/verification/lem/cases) as a scene.
#pragma once

#include <algorithm>
#include <cctype>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "core/scene/scene.hpp"

namespace breach::lem::cases {

using nlohmann::json;

inline json load(const std::string& id) {
    std::ifstream file(std::string(BREACH_ROOT) + "/tests/verification/lem/cases/" + id + ".json");
    return json::parse(file);
}

/// Problems in feet and pounds keep their feet; their stresses and unit weights are all divided by
/// ten, which F does not see. g = 10 makes densities round.
inline json scene_json(const json& problem) {
    json scene{{"format", "breachline-scene/1"}, {"gravity", 10.0}, {"lem", json::object()}};
    const double stress = problem.at("units") == "m,kN" ? 1.0 : 0.1;
    std::string name = problem.at("id");
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    scene["name"] = name;
    for (const json& soil : problem.at("materials")) {
        const std::string& material = soil.at("name").get_ref<const std::string&>();
        scene["materials"][material] = {
            {"density", soil.at("gamma").get<double>() * 100.0 * stress},
            {"law",
             {{"type", "mohr_coulomb"},
              {"E_MPa", 10},
              {"nu", 0.3},
              {"c_kPa", soil.at("c").get<double>() * stress},
              {"phi_deg", soil.at("phi")}}}};
        json ring = soil.at("polygon");
        ring.push_back(ring.front());
        if (soil.at("ru") != 0.0) {
            scene["lem"]["pore_pressure_ratios"].push_back(
                {{"region", material}, {"r_u", soil.at("ru")}});
        }
        scene["section"]["regions"].push_back(
            {{"name", material}, {"material", material}, {"polygon", ring}});
    }
    if (!problem.at("circle").is_null()) {
        const json& circle = problem.at("circle");
        scene["lem"]["circle"] = {{"center", {circle[0], circle[1]}}, {"radius", circle[2]}};
    }
    if (!problem.at("search").is_null()) {
        json search = problem.at("search");
        search["minimum_depth"] = problem.at("min_depth");
        if (!problem.at("ymin").is_null()) search["lowest_level"] = problem.at("ymin");
        scene["lem"]["search"] = search;
    }
    if (!problem.at("floor").is_null()) scene["lem"]["floor"] = problem.at("floor");
    scene["lem"]["seismic_coefficient"] = problem.at("kh");
    if (!problem.at("water_line").is_null()) {
        scene["lem"]["water"] = {{"line", problem.at("water_line")},
                                 {"density", problem.at("gamma_w").get<double>() * 100.0 * stress}};
        if (problem.at("hu_auto")) scene["lem"]["water"]["correction"] = "cos2";
    }
    for (const json& load : problem.at("surcharge")) {
        scene["lem"]["surcharge"].push_back(
            {{"from", load[0]}, {"to", load[1]}, {"pressure_kPa", load[2].get<double>() * stress}});
    }
    return scene;
}

inline scene::Scene scene_of(const json& problem) {
    return scene::parse_scene(scene_json(problem).dump(), problem.at("id"));
}

}  // namespace breach::lem::cases
