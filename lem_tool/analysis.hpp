// The phase: the scene's circle and search, their factors of safety as result.json and as figure
// data.
#pragma once

#include "core/process/phase.hpp"

namespace breach::lem {

/// Raised when the numbers change for the same input: the cache takes no result of another one.
inline constexpr int numerics = 6;

process::Plan plan(const scene::Scene& scene);

/// Analyses what /lem asks for. result.json: factor_of_safety, circle, entry, exit, lowest_point,
/// sliding_depth, surfaces_*, seconds; with both a circle and a search the circle's facts are under
/// "given_circle"; with /lem/non_circular those of its surfaces under "given_polyline" and
/// "non_circular". surfaces.h5: the best circle of each pair of ends and the slices of the critical
/// one. Throws BadInput when the given circle cannot be analysed or the search finds no surface at
/// all.
process::Outcome run(process::Session& session);

}  // namespace breach::lem
