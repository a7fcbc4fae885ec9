// What the shaking has done to each place at its worst. Liquefied soil does not regain strength when
// its pore pressure falls, so the transfer decides by the largest values and not by the last ones.
// take_trial (dynamic_stage.cpp) calls keep_largest after every accepted step; snapshots and
// checkpoints store the result.
#pragma once

#include "fem_solver/solve/beginning.hpp"

namespace breach::fem {

/// Since the first dynamic stage began, of the body; all empty if the scene is dry.
struct Largest {
    std::vector<double> excess_pressure;  ///< per node [Pa]
    std::vector<double> r_u;              ///< per Gauss point [-]
    std::vector<double> shear_strain;     ///< per Gauss point, engineering, in the plane [-]
};

/// `excess`: u - u_0 at the nodes of the body, smoothed [Pa].
void keep_largest(const Model& model, const Motion& motion, const Beginning& beginning,
                  const std::vector<double>& excess, Largest& largest);

}  // namespace breach::fem
