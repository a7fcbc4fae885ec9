// The scene as limit equilibrium sees it: every material with its strength at failure, every
// liquefying layer a region of its own.
#pragma once

#include "core/scene/scene.hpp"

namespace breach::lem {

/// Materials with a `limit_strength`, or a strength profile in its place, have a Mohr-Coulomb law of
/// that strength; regions that
/// /lem/liquefaction divides by levels are cut there, and the entries of /lem name the parts.
/// Throws BadInput when a layer's levels leave nothing of its region.
scene::Scene limit_scene(const scene::Scene& scene);

}  // namespace breach::lem
