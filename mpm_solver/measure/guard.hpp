// Blow-up guard: ends a run that has gone wrong, and reports where and when. A run that has lost
// its mass must not end well.
#pragma once

#include <optional>
#include <string>

#include "mpm_solver/measure/energy.hpp"

namespace breach::mpm {

struct Limits {
    double speed;         ///< a point faster than this has run away [m/s]
    double energy_gain;   ///< relative to energy_scale [-]
    double energy_floor;  ///< smaller gains are noise, for any energy released [J]
    double volume_ratio;  ///< the soil's volume over the initial one [-]
};

/// Limits for a body at the start. `swing`: largest change of the ground's velocity to come [m/s].
Limits limits_of(const Body& body, const scene::Mpm& mpm, const Energy& start, double swing = 0.0);

/// After every step: lost point, NaN, runaway velocity. Empty when all is well.
std::optional<std::string> step_complaint(const Body& body, const Limits& limits);

/// At every look: a point that sank a cell deep into the terrain. Empty when there is none.
std::optional<std::string> ground_complaint(const Body& body);

/// At every look: energy without a source, increased or vanished volume.
std::optional<std::string> budget_complaint(const Limits& limits, const Energy& start,
                                            const Energy& now, double volume_ratio);

}  // namespace breach::mpm
