// The body at time 0: from the transfer's points, or from the section filled with points.
#pragma once

#include "core/process/session.hpp"
#include "mpm_solver/body/body.hpp"

namespace breach::mpm {

struct Begun {
    Body body;
    double transfer_time;  ///< on the FEM's clock [s]
};

/// Logs how faithfully each region is sampled. Throws BadInput when points lie outside the grid or
/// below the terrain.
Begun begin(const process::Session& session);

Computing computing_of(const process::Session& session);

}  // namespace breach::mpm
