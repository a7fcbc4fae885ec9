// Scenes of the catalogue of `breach verify`, for modified tests.
#pragma once

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "core/scene/scene.hpp"

namespace breach::lem::cases {

using nlohmann::json;

inline json load(const std::string& name) {
    std::ifstream file(std::string(BREACH_ROOT) + "/workflows/verification/catalogue/lem/" + name +
                       ".json");
    return json::parse(file);
}

inline scene::Scene scene_of(const std::string& name) {
    return scene::parse_scene(load(name).dump(), name);
}

}  // namespace breach::lem::cases
