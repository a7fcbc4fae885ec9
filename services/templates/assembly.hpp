// Builds a scene from an outline: layers, materials with assumptions, and each phase's part. Called
// by templates.cpp, after the options were checked against each other.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "services/earthquake/earthquake.hpp"
#include "services/templates/outline.hpp"

namespace breach::templates {

nlohmann::ordered_json scene_of(const Values& values, const Outline& outline,
                                const std::string& name);

/// Gauges at the toe and one and three heights beyond it, up to x = right; a hydrograph at the toe.
void add_gauges(nlohmann::ordered_json& mpm, double toe, double height, double right);

/// What the variant of a dam that stands changes, so that it comes to rest.
nlohmann::ordered_json overrides_of_standing(const nlohmann::ordered_json& materials);

earthquake::Motion motion_in(const Values& values);

/// The study of the scene, with the same name and title; its scene is "scene.json" beside it.
nlohmann::ordered_json study_of(const Values& values, const nlohmann::ordered_json& scene);

}  // namespace breach::templates
