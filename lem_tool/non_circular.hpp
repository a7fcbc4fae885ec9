// /lem/non_circular as facts of result.json: the given surface of straight pieces and the optimised
// one.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/scene/scene.hpp"
#include "lem_tool/search.hpp"

namespace breach::lem {

/// "given_polyline". Throws BadInput where the given surface is none.
nlohmann::json given_polyline(const scene::Scene& scene, const Model& model);

/// "non_circular": the optimised surface; null where the circle it starts from has no answer by
/// Spencer's method.
nlohmann::json optimised_polyline(const scene::Scene& scene, const Model& model,
                                  const Surface& circle);

/// What a reader of the optimised surface must know.
std::vector<fault::Flag> flags_of_polyline(const nlohmann::json& optimised);

}  // namespace breach::lem
