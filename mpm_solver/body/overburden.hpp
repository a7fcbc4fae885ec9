// Overburden: the initial stress of filled points.
// Used by fill.cpp under "fill_stress": "overburden". Without it soil falls into its weight at the
// start.
#pragma once

#include "core/mechanics/elasticity.hpp"
#include "core/scene/standing_water.hpp"

namespace breach::mpm {

/// Vertical stress from the weight of the regions above `place`, with standing water their weight
/// less its pressure's rise from the ground down to there; compression positive [Pa].
double overburden(const scene::Scene& scene, const scene::StandingWater& water,
                  const scene::Vec2& place);

/// sigma_v with the lateral stress of a confined column, K_0 = nu / (1 - nu); tension positive
/// [Pa].
mechanics::Voigt column_stress(double sigma_v, double nu);

}  // namespace breach::mpm
