// Facts of /lem/non_circular for result.json: the given and the optimised polyline.
// answer.cpp calls them where /lem/non_circular or a thin weak layer asks for a polyline.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/scene/scene.hpp"
#include "lem_tool/optimise.hpp"

namespace breach::lem {

/// "given_polyline". Throws BadInput if the given polyline is invalid.
nlohmann::json given_polyline(const scene::Scene& scene, const Model& model);

/// "non_circular": the optimised polyline; null if Spencer's method fails for the initial circle.
nlohmann::json optimised_polyline(const scene::Scene& scene, const Model& model,
                                  const std::vector<Start>& starts);

/// Whether most of a polyline's base is without friction, other than in a thin layer under soil
/// with friction. Its factor neglects internal shearing of the mass at the kinks.
bool kinks_without_friction(const nlohmann::json& polyline);

}  // namespace breach::lem
