// Converts the scene for limit equilibrium: all materials with their strength at failure, each
// liquefying layer a region of its own.
// The first step of plan, run and probability. The scene as written is needed beside it where names
// of entries or states of soil matter (variation.cpp, drained.cpp).
#pragma once

#include <vector>

#include "core/scene/scene.hpp"

namespace breach::lem {

/// Materials with a `limit_strength`, or else a strength profile, get a Mohr-Coulomb law of that
/// strength. Regions that /lem/liquefaction divides by levels are cut there, and the entries of
/// /lem then name the parts. Throws BadInput if a layer's levels contain no soil of its region.
scene::Scene limit_scene(const scene::Scene& scene);

/// For each entry of the scene's /lem/undrained, the entries of limit_scene that replace it.
std::vector<std::vector<std::size_t>> undrained_parts(const scene::Scene& scene);

}  // namespace breach::lem
