// The body at time 0: from the transfer's points, or from the section filled with points.
#pragma once

#include "core/process/session.hpp"
#include "mpm_solver/body/body.hpp"
#include "mpm_solver/body/ground_motion.hpp"

namespace breach::mpm {

struct Begun {
    Body body;
    double transfer_time;                  ///< on the FEM's clock [s]
    std::optional<GroundMotion> ground{};  ///< nothing: at rest
};

/// Logs the sampling error of each region. With moving ground, the points' places and velocities are relative
/// to it: the transfer's minus the ground's at that moment. Throws BadInput when points lie outside the grid
/// or below the terrain, or when the motion of the ground is missing.
Begun begin(const process::Session& session);

/// Converts places and velocities of the points from far rock to the ground, the reference of the
/// section: floor, terrain, walls, toe and gauges.
void stand_on_ground(const GroundMotion& ground, exchange::ParticleState& state);

Computing computing_of(const process::Session& session);

}  // namespace breach::mpm
