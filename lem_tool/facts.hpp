// Surfaces and searches as facts of result.json, and reasons for refusals.
// Numbers of one surface for answer.cpp; which of them counts is decided there.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/scene/scene.hpp"
#include "lem_tool/search.hpp"

namespace breach::lem {

/// Facts about one analysed surface; `slices` then has its slices.
nlohmann::json facts_of(const Model& model, const Critical& critical, Slices& slices);
nlohmann::json facts_of(const Tally& tally);

/// Bishop's factor for the circle's mass with the lowest factor; a circle can cut off several.
/// Throws BadInput if there is none.
Critical analyse_circle(const scene::Scene& scene, const Model& model, Slices& slices);

/// Throws BadInput: the search found no surface.
[[noreturn]] void refuse_search(const scene::Scene& scene, const Model& model, const Tally& tally);

}  // namespace breach::lem
