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

/// Logs how faithfully each region is sampled. Where the ground shakes on, the points' places and
/// velocities are those on it: what the transfer wrote less the ground's at that moment. Throws BadInput when
/// points lie outside the grid or below the terrain, or when nothing says how the ground moves.
Begun begin(const process::Session& session);

/// Places and velocities of the points against far rock become those on the ground, to which the section
/// belongs: floor, terrain, walls, toe and gauges.
void stand_on_ground(const GroundMotion& ground, exchange::ParticleState& state);

Computing computing_of(const process::Session& session);

}  // namespace breach::mpm
