// One step: a share of the load in statics, Newmark in dynamics. Says how it went; the analysis
// decides what follows.
#pragma once

#include "fem_solver/newton.hpp"

namespace breach::fem {

struct Newmark {
    double beta;   ///< [-]
    double gamma;  ///< [-]
};

/// Equilibrium at `load` times the external force. trial starts at old.u; velocities stay zero.
NewtonOutcome static_step(Newton& newton, const std::vector<materials::Law>& laws,
                          const Motion& old, double load, Motion& trial);

/// Scratch vectors of a dynamic step.
struct Prediction {
    Eigen::VectorXd u, v;
};

/// From `old` over dt [s] to `trial` (Newmark 1959, displacement form).
NewtonOutcome dynamic_step(Newton& newton, const std::vector<materials::Law>& laws,
                           const Newmark& newmark, double dt, const Motion& old,
                           Prediction& prediction, Motion& trial);

/// Puts the stresses on the yield surface of the laws now in force (zero strain increment) and sets
/// the accelerations that the unbalanced force causes: M a = f_ext - f_int - C v.
void start_motion(Newton& newton, const Model& model, const std::vector<materials::Law>& laws,
                  Motion& motion, Motion& scratch);

}  // namespace breach::fem
