#include "fem_solver/solve/step.hpp"

#include "fem_solver/model/nonlocal.hpp"
#include "fem_solver/model/pore_water.hpp"

namespace breach::fem {

namespace {

/// Softening is explicit: what its strains become at the end of a step changes no stress of the step.
void share_softening(const Model& model, const Motion& old, Motion& trial) {
    if (model.nonlocal) model.nonlocal->share(model, old, trial);
}

}  // namespace

Prediction prediction_for(const Model& model) {
    Prediction prediction;
    prediction.u = prediction.v = prediction.external = Eigen::VectorXd::Zero(model.dofs());
    prediction.p_rate = Eigen::VectorXd::Zero(model.water.prescribed.size());
    return prediction;
}

NewtonOutcome static_step(Newton& newton, const Model& model,
                          const std::vector<materials::Law>& laws, double load,
                          const Eigen::VectorXd& start, const Motion& old, Prediction& prediction,
                          Motion& trial) {
    trial.u = old.u;
    if (prediction.driven.size() > 0) trial.u += prediction.driven;
    trial.p = old.p;
    trial.p_rate = old.p_rate;
    prediction.external = model.external_force;
    const bool drains = model.undrained.empty();
    if (drains) add_pressure_force(model, old.p, prediction.external);
    prediction.external = load * prediction.external + (1.0 - load) * start;
    const TimeRule rule = drains ? TimeRule{} : TimeRule{.c_a = 0.0, .c_v = 1.0};
    if (prediction.driven.size() > 0) {
        // The edge's rows alone would take all of the displacement: an elastic solution distributes
        // it first.
        const auto elastic = laws_for(model, scene::StageLaws::elastic);
        newton.forget_matrix();
        newton.solve({elastic, old, rule, prediction.external, old.u, old.v, old.p_rate}, trial);
        newton.forget_matrix();
    }
    const NewtonOutcome outcome =
        newton.solve({laws, old, rule, prediction.external, old.u, old.v, old.p_rate}, trial);
    share_softening(model, old, trial);
    // Statics has no time: c_v = 1/s made increments of "velocities" only for the balance of water.
    trial.v.setZero();
    trial.p_rate.setZero();
    return outcome;
}

void set_external_force(const Model& model, const Beginning& beginning, double time,
                        Eigen::VectorXd& force) {
    force = model.external_force;
    if (beginning.base_reaction.size() > 0) force += beginning.base_reaction;
    if (model.base.any()) model.base.add_force(time, force);
    // All of it at the stage's beginning, which leaves nothing out of balance, and linearly less
    // until the ramp's end.
    const double gone = time - model.withheld_from;
    if (model.withheld.size() > 0 && gone < model.withheld_for)
        force += (1.0 - gone / model.withheld_for) * model.withheld;
}

NewtonOutcome dynamic_step(Newton& newton, const Model& model,
                           const std::vector<materials::Law>& laws, const Newmark& newmark,
                           const Beginning& beginning, double dt, double end, const Motion& old,
                           Prediction& prediction, Motion& trial) {
    const auto [beta, gamma] = newmark;
    prediction.u = old.u + dt * old.v + dt * dt * (0.5 - beta) * old.a;
    prediction.v = old.v + dt * (1.0 - gamma) * old.a;
    // From p_1 = p_0 + dt ((1 - gamma) p'_0 + gamma p'_1), solved for p'_1 at p_1 = p_0.
    prediction.p_rate = -(1.0 - gamma) / gamma * old.p_rate;
    set_external_force(model, beginning, end, prediction.external);
    trial.u = prediction.u + beta * dt * dt * old.a;  // constant acceleration as first guess
    trial.p = old.p + dt * old.p_rate;                // constant pressure rate
    const TimeRule rule{1.0 / (beta * dt * dt), gamma / (beta * dt)};
    const NewtonOutcome outcome = newton.solve(
        {laws, old, rule, prediction.external, prediction.u, prediction.v, prediction.p_rate},
        trial);
    share_softening(model, old, trial);
    return outcome;
}

void settle_stresses(Newton& newton, const std::vector<materials::Law>& laws, Motion& motion,
                     Motion& scratch) {
    scratch = motion;
    newton.internal_force().evaluate(laws, motion, scratch);
    // Strains and displacement stay: nothing has moved.
    motion.points = scratch.points;
    motion.memory = scratch.memory;
    motion.force = scratch.force;
}

Eigen::VectorXd unbalanced_force(Newton& newton, const Model& model, const Beginning& beginning,
                                 double time, const Motion& motion) {
    Eigen::VectorXd acting;
    set_external_force(model, beginning, time, acting);
    add_pressure_force(model, motion.p, acting);
    Eigen::VectorXd force = motion.force - acting;
    force.array() += model.mass.array() * motion.a.array();
    newton.add_damping_force(1.0, motion.v, force);
    return force;
}

void set_acceleration(Newton& newton, const Model& model, const Beginning& beginning, double time,
                      Prediction& prediction, Motion& motion) {
    Eigen::VectorXd& R = prediction.external;
    set_external_force(model, beginning, time, R);
    add_pressure_force(model, motion.p, R);
    R -= motion.force;
    newton.add_damping_force(-1.0, motion.v, R);
    const Unknowns& n = newton.unknowns();
    // A tied group has one acceleration: forces and masses are summed over its dofs.
    Eigen::VectorXd force = Eigen::VectorXd::Zero(n.displacements), mass = force;
    for (std::size_t d = 0; d < n.of_dof.size(); ++d) {
        if (n.of_dof[d] < 0) continue;
        const auto i = static_cast<Eigen::Index>(d);
        const double weight = model.row_weight.size() > 0 ? model.row_weight[i] : 1.0;
        force[n.of_dof[d]] += weight * R[i];
        mass[n.of_dof[d]] += weight * model.mass[i];
    }
    motion.a.setZero();
    for (std::size_t d = 0; d < n.of_dof.size(); ++d) {
        const std::int32_t i = n.of_dof[d];
        // At a free base without soil there are only dashpots.
        if (i >= 0 && mass[i] > 0.0) motion.a[static_cast<Eigen::Index>(d)] = force[i] / mass[i];
    }
}

}  // namespace breach::fem
