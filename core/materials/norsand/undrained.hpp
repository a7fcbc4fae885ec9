// Strength of a NorSand state in further undrained shear in the plane, and its strength at the
// critical state of its void ratio.
#pragma once

#include "core/materials/norsand/norsand.hpp"
#include "core/materials/state_parameter.hpp"

namespace breach::materials::norsand {

/// Shear stress in the plane, (sigma_1 - sigma_3) / 2 [Pa].
double plane_shear(const State& state);

/// The law's own path from `state` at constant volume along its deviator in the plane, with the
/// law's S. Critical: tau = M cos(theta) / sqrt(3) p_c(e) (docs/reference/methods/norsand.md, section
/// 15). `bound` [Pa]: upper limit of the mean effective stress on a path (where dilating soil has
/// sucked its water to p = 0); strengths are at most the critical ones there.
UndrainedStrength undrained_strength(const Ready& law, const State& state, double bound);
/// The same of many states, side by side: to the last bit what each alone gives.
std::vector<UndrainedStrength> undrained_strengths(const Ready& law, std::span<const State> states,
                                                   std::span<const double> bounds);

/// Shear stress on the plane across y, |tau_xy| [Pa].
double simple_shear(const State& state);

/// The same in undrained simple shear, epsilon_xx = epsilon_yy = epsilon_zz = 0: for soil
/// consolidated under level ground, on a horizontal plane.
UndrainedStrength simple_shear_strength(const Ready& law, const State& state, double bound);

}  // namespace breach::materials::norsand
