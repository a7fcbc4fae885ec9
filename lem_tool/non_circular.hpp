// /lem/non_circular as facts of result.json: the given surface of straight pieces and the optimised
// one.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/scene/scene.hpp"
#include "lem_tool/search.hpp"

namespace breach::lem {

/// "given_polyline". Throws BadInput where the given surface is invalid.
nlohmann::json given_polyline(const scene::Scene& scene, const Model& model);

/// "non_circular": the optimised surface; null where the circle it starts from has no answer by
/// Spencer's method.
nlohmann::json optimised_polyline(const scene::Scene& scene, const Model& model,
                                  const Surface& circle);

/// Most of a polyline's base has no friction, and not as a thin layer under soil with friction: its
/// factor neglects the internal shearing of the mass at the kinks.
bool kinks_without_friction(const nlohmann::json& polyline);

}  // namespace breach::lem
