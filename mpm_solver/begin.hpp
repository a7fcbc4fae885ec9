// The body at time 0, from the transfer's points or from the section filled with points.
#pragma once

#include "core/process/session.hpp"
#include "mpm_solver/body/body.hpp"
#include "mpm_solver/body/ground_motion.hpp"

namespace breach::mpm {

struct Begun {
    Body body;
    double transfer_time;                  ///< on the FEM's clock [s]
    std::optional<GroundMotion> ground{};  ///< none: at rest
};

/// Logs the sampling error of each region. With moving ground, positions and velocities are
/// relative to it: the transfer's minus those of the ground at that time. Throws BadInput if points
/// are outside the grid or below the terrain, or if the ground motion is missing.
Begun begin(const process::Session& session);

/// Converts positions and velocities of the points from far rock to the moving ground, the
/// reference of floor, terrain, walls, toe and gauges.
void stand_on_ground(const GroundMotion& ground, exchange::ParticleState& state);

/// The threads of the command line with the widest instruction set of this CPU. The number of
/// threads does not change a bit of the result; the instruction set changes it by round-off.
Computing computing_of(const process::Session& session);

}  // namespace breach::mpm
