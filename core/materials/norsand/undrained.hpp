// Undrained strength of a NorSand state on its path: peak and residual
// (docs/reference/methods/norsand.md, section 15).
#pragma once

#include "core/materials/norsand/norsand.hpp"
#include "core/materials/state_parameter.hpp"

namespace breach::materials::norsand {

/// In-plane shear stress (sigma_1 - sigma_3) / 2 [Pa].
double plane_shear(const State& state);

/// Integrates the law from `state` at constant volume along its in-plane deviator, with the law's
/// S. `bound` [Pa]: upper limit of p', at which dilating soil has lowered the pore pressure to 0;
/// strengths are at most the critical strength there.
UndrainedStrength undrained_strength(const Ready& law, const State& state, double bound);
/// The same for many states, side by side, with the same bits.
std::vector<UndrainedStrength> undrained_strengths(const Ready& law, std::span<const State> states,
                                                   std::span<const double> bounds);

/// |tau_xy| on horizontal planes [Pa].
double simple_shear(const State& state);

/// The same in undrained simple shear (epsilon_xx = epsilon_yy = epsilon_zz = 0) on a horizontal
/// plane, for soil consolidated under level ground.
UndrainedStrength simple_shear_strength(const Ready& law, const State& state, double bound);

}  // namespace breach::materials::norsand
