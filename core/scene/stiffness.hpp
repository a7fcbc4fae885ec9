// Stiffness of soil in the runout. Its compression waves limit the time step. A flow needs waves of
// only ten times the free-fall speed; undrained soil has about 2 km/s.
#pragma once

#include <optional>

#include "core/mechanics/elasticity.hpp"
#include "core/scene/scene.hpp"

namespace breach::scene {

/// Free-fall speed from the highest mobile soil to the lowest ground [m/s].
double fall_speed(const Scene& scene, const Mpm& mpm);

/// Five would halve the cost. But runouts of two scenes were then 10 to 14 % shorter than at full
/// stiffness (docs/verification/mpm_convergence.md).
inline constexpr double waves_per_fall = 10.0;

/// Limit of compression wave speeds for `"stiffness_scale": "auto"` [m/s]: 10 times fall_speed.
/// None if soil keeps its stiffness: no material yields, the time step is given, the shaking
/// continues, or there is no gravity.
std::optional<double> wave_speed_limit(const Scene& scene, const Mpm& mpm);

mechanics::Elasticity elasticity_in_runout(const Material& material, const Mpm& mpm);

/// The fastest compression wave of all soils [m/s].
double fastest_wave(const Scene& scene, const Mpm& mpm);

/// Limit of fall_speed / fastest_wave for a given stiffness; more is refused.
constexpr double refused_mach = 0.3;

}  // namespace breach::scene
