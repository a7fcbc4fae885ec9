// One step: a load share in statics, Newmark in dynamics. The caller decides how to continue.
// Stages (static_stage.cpp, dynamic_stage.cpp) and the columns alone (base_motion.cpp) share these
// functions.
#pragma once

#include "fem_solver/solve/beginning.hpp"
#include "fem_solver/solve/newton.hpp"

namespace breach::fem {

struct Newmark {
    double beta;   ///< [-]
    double gamma;  ///< [-]
};

/// Scratch memory of a step.
/// Kept in Course between steps, so that no step allocates vectors of the mesh's size.
struct Prediction {
    Eigen::VectorXd u, v;      ///< per dof
    Eigen::VectorXd p_rate;    ///< per node
    Eigen::VectorXd external;  ///< force at the end of the step, per dof [N]
    /// static: displacements of driven nodes in this step, per dof; empty: none [m]
    Eigen::VectorXd driven;
};

Prediction prediction_for(const Model& model);

/// Equilibrium at the share `load` between the force `start` [N] and the external force with the
/// pore pressure, which a static step does not change. In undrained regions the pressure is
/// unknown; neither force includes it. trial starts at old.u; velocities stay zero.
NewtonOutcome static_step(Newton& newton, const Model& model,
                          const std::vector<materials::Law>& laws, double load,
                          const Eigen::VectorXd& start, const Motion& old, Prediction& prediction,
                          Motion& trial);

/// From `old` over dt to the time `end` [s]: Newmark (1959) in displacement form for u, and the
/// first-order analogue p_1 = p_0 + dt ((1 - gamma) p'_0 + gamma p'_1) for p.
NewtonOutcome dynamic_step(Newton& newton, const Model& model,
                           const std::vector<materials::Law>& laws, const Newmark& newmark,
                           const Beginning& beginning, double dt, double end, const Motion& old,
                           Prediction& prediction, Motion& trial);

/// Returns the stresses to the yield surface of the present laws (zero strain increment).
void settle_stresses(Newton& newton, const std::vector<materials::Law>& laws, Motion& motion,
                     Motion& scratch);

/// Sets the accelerations of the unbalanced force at `time` [s]: M a = f_ext - f_int + Q p - C v.
void set_acceleration(Newton& newton, const Model& model, const Beginning& beginning, double time,
                      Prediction& prediction, Motion& motion);

/// M a + C v + f_int - Q p - f_ext at `time` [s], per dof [N]: applied as a load, it lets the
/// present motion continue unchanged.
Eigen::VectorXd unbalanced_force(Newton& newton, const Model& model, const Beginning& beginning,
                                 double time, const Motion& motion);

/// External force at a time [s]: weight, loads, base reaction, input motion.
void set_external_force(const Model& model, const Beginning& beginning, double time,
                        Eigen::VectorXd& force);

}  // namespace breach::fem
