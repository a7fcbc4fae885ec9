// From an outline to a scene: layers, materials with what is assumed of them, and each phase's part.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "services/templates/outline.hpp"

namespace breach::templates {

/// The scene; `name` and its title stand in it.
nlohmann::ordered_json scene_of(const Values& values, const Outline& outline,
                                const std::string& name);

/// The study that runs it, named and entitled alike; the scene is "scene.json" beside it.
nlohmann::ordered_json study_of(const Values& values, const nlohmann::ordered_json& scene);

}  // namespace breach::templates
