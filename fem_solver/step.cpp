#include "fem_solver/step.hpp"

namespace breach::fem {

NewtonOutcome static_step(Newton& newton, const std::vector<materials::Law>& laws,
                          const Motion& old, double load, Motion& trial) {
    trial.u = old.u;
    return newton.solve(laws, old, TimeRule{}, load, old.u, old.v, trial);
}

NewtonOutcome dynamic_step(Newton& newton, const std::vector<materials::Law>& laws,
                           const Newmark& newmark, double dt, const Motion& old,
                           Prediction& prediction, Motion& trial) {
    const auto [beta, gamma] = newmark;
    prediction.u = old.u + dt * old.v + dt * dt * (0.5 - beta) * old.a;
    prediction.v = old.v + dt * (1.0 - gamma) * old.a;
    trial.u = prediction.u + beta * dt * dt * old.a;  // first guess: the acceleration goes on
    const TimeRule rule{1.0 / (beta * dt * dt), gamma / (beta * dt)};
    return newton.solve(laws, old, rule, 1.0, prediction.u, prediction.v, trial);
}

void start_motion(Newton& newton, const Model& model, const std::vector<materials::Law>& laws,
                  Motion& motion, Motion& scratch) {
    scratch = motion;
    newton.internal_force().evaluate(laws, motion, scratch);
    motion.points = scratch.points;
    motion.force = scratch.force;
    motion.a = (model.external_force - motion.force).array() / model.mass.array() -
               model.rayleigh.mass * motion.v.array();
    for (std::size_t d = 0; d < model.unknowns.of_dof.size(); ++d) {
        if (model.unknowns.of_dof[d] < 0) motion.a[static_cast<Eigen::Index>(d)] = 0.0;
    }
}

}  // namespace breach::fem
