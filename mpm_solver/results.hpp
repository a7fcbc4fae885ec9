// Results of a finished run besides its points: result.json, history.h5 and the deposit in
// profile.csv.
#pragma once

#include "core/process/session.hpp"
#include "mpm_solver/simulation.hpp"

namespace breach::mpm {

/// speed: particle steps per CPU second.
void write_results(process::Session& session, const Simulation& simulation, double speed);

}  // namespace breach::mpm
