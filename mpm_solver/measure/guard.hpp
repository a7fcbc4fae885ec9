// Ends a run that has gone wrong (blow-up, lost mass), and reports where and when.
// Simulation::advance asks step_complaint after every step, which costs no pass over the points;
// Simulation::look asks the others. Each complaint ends the run with exit code 70.
#pragma once

#include <optional>
#include <string>

#include "mpm_solver/measure/energy.hpp"

namespace breach::mpm {

struct Limits {
    double speed;         ///< a faster point counts as runaway [m/s]
    double energy_gain;   ///< over the energy released, at least energy_floor [-]
    double energy_floor;  ///< smaller gains are noise [J]
    double volume_ratio;  ///< soil volume over the initial one [-]
};

/// Limits for a body at the start. `swing`: largest later change of the ground's velocity [m/s].
Limits limits_of(const Body& body, const scene::Mpm& mpm, const Energy& start, double swing = 0.0);

/// After every step: lost point, NaN, runaway velocity. Empty: none.
std::optional<std::string> step_complaint(const Body& body, const Limits& limits);

/// At every measurement: a point more than a cell deep in the terrain. Empty: none.
std::optional<std::string> ground_complaint(const Body& body);

/// At every measurement: energy without source, volume gained or lost.
std::optional<std::string> budget_complaint(const Limits& limits, const Energy& start,
                                            const Energy& now, double volume_ratio);

}  // namespace breach::mpm
