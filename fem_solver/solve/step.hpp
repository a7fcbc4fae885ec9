// One step: a share of the load in statics, Newmark in dynamics. Returns the outcome; the analysis
// decides how to continue.
#pragma once

#include "fem_solver/solve/beginning.hpp"
#include "fem_solver/solve/newton.hpp"

namespace breach::fem {

struct Newmark {
    double beta;   ///< [-]
    double gamma;  ///< [-]
};

/// Scratch of a step.
struct Prediction {
    Eigen::VectorXd u, v;      ///< per dof
    Eigen::VectorXd p_rate;    ///< per node
    Eigen::VectorXd external;  ///< force at the end of the step, per dof [N]
    Eigen::VectorXd driven;    ///< static: held nodes move so in the step, per dof; empty: none [m]
};

Prediction prediction_for(const Model& model);

/// Equilibrium when a share `load` of the way from the force `start` [N] to the external force and
/// that of the pore pressure, which a static step does not change, has been gone. Where the model is
/// undrained the pressure is sought: neither force holds its own. trial starts at old.u; velocities
/// stay zero.
NewtonOutcome static_step(Newton& newton, const Model& model,
                          const std::vector<materials::Law>& laws, double load,
                          const Eigen::VectorXd& start, const Motion& old, Prediction& prediction,
                          Motion& trial);

/// From `old` over dt to time `end` [s]: Newmark (1959) in displacement form for u, its first-order
/// analogue p_1 = p_0 + dt ((1 - gamma) p'_0 + gamma p'_1) for p.
NewtonOutcome dynamic_step(Newton& newton, const Model& model,
                           const std::vector<materials::Law>& laws, const Newmark& newmark,
                           const Beginning& beginning, double dt, double end, const Motion& old,
                           Prediction& prediction, Motion& trial);

/// Puts the stresses on the yield surface of the laws now in force (zero strain increment).
void settle_stresses(Newton& newton, const std::vector<materials::Law>& laws, Motion& motion,
                     Motion& scratch);

/// Sets the accelerations that the unbalanced force causes at `time` [s]: M a = f_ext - f_int + Q p
/// - C v.
void set_acceleration(Newton& newton, const Model& model, const Beginning& beginning, double time,
                      Prediction& prediction, Motion& motion);

/// M a + C v + f_int - Q p - f_ext at `time` [s], for the present motion: the force that would let
/// the motion continue unchanged, per dof [N].
Eigen::VectorXd unbalanced_force(Newton& newton, const Model& model, const Beginning& beginning,
                                 double time, const Motion& motion);

/// External force at a time [s]: weight and loads, the base's reaction, the motion from below.
void set_external_force(const Model& model, const Beginning& beginning, double time,
                        Eigen::VectorXd& force);

}  // namespace breach::fem
