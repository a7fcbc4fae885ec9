// Surfaces and searches as facts of result.json, and reasons for refusals.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/scene/scene.hpp"
#include "lem_tool/search.hpp"

namespace breach::lem {

/// All facts about one analysed surface; leaves its slices in `slices`.
nlohmann::json facts_of(const Model& model, const Critical& critical, Slices& slices);
nlohmann::json facts_of(const Tally& tally);

/// Bishop on the mass of the circle with the lowest factor of safety; a circle can cut off several.
/// Throws BadInput when there is none.
Critical analyse_circle(const scene::Scene& scene, const Model& model, Slices& slices);

/// Throws BadInput: a search found no surface.
[[noreturn]] void refuse_search(const scene::Scene& scene, const Model& model, const Tally& tally);

/// The search. Throws BadInput if it finds no surface.
SearchResult found_by_search(const scene::Scene& scene, const Model& model, int threads);

}  // namespace breach::lem
