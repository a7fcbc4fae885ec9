// Stiffness of soil in the runout. Its compression waves set the time step; a flow needs waves no
// faster than ten times a free fall, and undrained soil has some of 2 km/s.
#pragma once

#include <optional>

#include "core/mechanics/elasticity.hpp"
#include "core/scene/scene.hpp"

namespace breach::scene {

/// Speed of soil that has lost no energy after the deepest fall, from the highest mobile soil to the
/// lowest ground [m/s].
double fall_speed(const Scene& scene, const Mpm& mpm);

/// The limit on compression waves of `"stiffness_scale": "auto"` [m/s]: 10 times fall_speed.
/// Nothing where soil keeps its stiffness: no material yields, the time step is given, the shaking
/// continues, there is no gravity.
std::optional<double> wave_speed_limit(const Scene& scene, const Mpm& mpm);

/// A material's elasticity as the runout has it.
mechanics::Elasticity elasticity_in_runout(const Material& material, const Mpm& mpm);

/// The fastest of all soils' compression waves [m/s].
double fastest_wave(const Scene& scene, const Mpm& mpm);

/// A given stiffness with fall_speed over fastest_wave above this is refused.
constexpr double refused_mach = 0.3;

}  // namespace breach::scene
