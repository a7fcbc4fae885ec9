// Converts the scene for limit equilibrium: every material has its strength at failure, every
// liquefying layer is a region of its own.
#pragma once

#include <vector>

#include "core/scene/scene.hpp"

namespace breach::lem {

/// Materials with a `limit_strength`, or a strength profile instead, have a Mohr-Coulomb law of
/// that strength; regions that /lem/liquefaction divides by levels are cut there, and the
/// entries of /lem name the parts. Throws BadInput when a layer's levels contain nothing of its
/// region.
scene::Scene limit_scene(const scene::Scene& scene);

/// For each entry of the scene's /lem/undrained, the entries of limit_scene that replace it.
std::vector<std::vector<std::size_t>> undrained_parts(const scene::Scene& scene);

}  // namespace breach::lem
