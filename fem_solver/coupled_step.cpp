#include "fem_solver/coupled_step.hpp"

#include <algorithm>
#include <cmath>

namespace breach::fem {

CoupledMotion coupled_at_rest(const Model& model) {
    const auto nodes = static_cast<Eigen::Index>(model.mesh.nodes.size());
    return {at_rest(model), Eigen::VectorXd::Zero(nodes), Eigen::VectorXd::Zero(nodes)};
}

CoupledStep::CoupledStep(const Model& model, const PoreWater& water, const AbsorbingBase& base,
                         NewtonSettings settings, Seconds& seconds)
    : model_(model),
      water_(water),
      base_(base),
      settings_(settings),
      seconds_(seconds),
      internal_force_(model, seconds),
      solid_(model, Symmetry::symmetric),
      system_(model, water, solid_) {
    if (model.rayleigh.stiffness > 0.0) {
        elastic_.emplace(model, Symmetry::symmetric);
        elastic_->clear();
        internal_force_.add_elastic_stiffness(1.0, *elastic_);
    }
    external_ = R_u_ = d_u_ = Eigen::VectorXd::Zero(model.dofs());
    R_p_ = exchanged_ = d_p_ =
        Eigen::VectorXd::Zero(static_cast<Eigen::Index>(model.mesh.nodes.size()));
}

bool CoupledStep::renew_matrix(const TimeRule& rule, double gamma_dt) {
    const Stopwatch watch(seconds_.solve);
    ++counts_.factorisations;
    solid_.add_diagonal(rule.c_a + rule.c_v * model_.rayleigh.mass, model_.mass);
    if (base_.dashpot.size() > 0) solid_.add_diagonal(rule.c_v, base_.dashpot);
    if (elastic_) {
        internal_force_.add_elastic_stiffness(rule.c_v * model_.rayleigh.stiffness, solid_);
    }
    has_matrix_ = system_.factorise(solid_, rule, gamma_dt) == Factorisation::done;
    rule_ = rule;
    return has_matrix_;
}

/// R_u = f - f_int - M a - C v + Q p;  R_p = flux - Q^T v - S p' - H p. Returns the larger of the
/// two in units of what they are the balance of.
double CoupledStep::set_residuals(const TimeRule& rule, const CoupledMotion& old,
                                  CoupledMotion& trial, const Newmark& newmark, double dt) {
    Motion& solid = trial.solid;
    const double gamma = newmark.gamma;
    solid.a = rule.c_a * (solid.u - u_predicted_);
    solid.v = v_predicted_ + rule.c_v * (solid.u - u_predicted_);
    trial.p_rate = (trial.p - old.p) / (gamma * dt) - (1.0 - gamma) / gamma * old.p_rate;
    R_u_ = external_ - solid.force;
    R_u_.array() -=
        model_.mass.array() * (solid.a.array() + model_.rayleigh.mass * solid.v.array());
    if (elastic_) elastic_->add_product(-model_.rayleigh.stiffness, solid.v, R_u_);
    if (base_.dashpot.size() > 0) R_u_.array() -= base_.dashpot.array() * solid.v.array();
    R_p_.setZero();
    exchanged_.setZero();
    double rounding = 0.0;  // what the terms lose in differences of large numbers, squared
    for (const PorousElement& each : water_.elements) {
        const Quad& quad = model_.mesh.quads[each.element];
        Eigen::Vector4d p, p_rate;
        for (int i = 0; i < 4; ++i) {
            p[i] = trial.p[quad[i]];
            p_rate[i] = trial.p_rate[quad[i]];
        }
        const double expansion = each.Q.dot(gather(quad, solid.v));
        const Eigen::Vector4d stored = each.S * p_rate, conducted = each.H * p;
        const double sum = p.sum();
        const double of_u = rule.c_v * each.Q.cwiseAbs().dot(gather(quad, solid.u).cwiseAbs());
        const double of_p =
            ((each.S / (gamma * dt)).cwiseAbs() + each.H.cwiseAbs()).row(0).dot(p.cwiseAbs());
        rounding += (of_u + of_p) * (of_u + of_p);
        for (int i = 0; i < 4; ++i) {
            R_u_.segment<2>(2 * static_cast<Eigen::Index>(quad[i])) +=
                sum * each.Q.segment<2>(2 * i);
            R_p_[quad[i]] += each.flux[i] - expansion - stored[i] - conducted[i];
            exchanged_[quad[i]] += std::abs(each.flux[i]) + std::abs(expansion) +
                                   std::abs(stored[i]) + std::abs(conducted[i]);
        }
    }
    for (std::size_t d = 0; d < model_.unknowns.of_dof.size(); ++d) {
        if (model_.unknowns.of_dof[d] < 0) R_u_[static_cast<Eigen::Index>(d)] = 0.0;
    }
    for (std::size_t n = 0; n < water_.unknown_of_node.size(); ++n) {
        if (water_.unknown_of_node[n] < 0) R_p_[static_cast<Eigen::Index>(n)] = 0.0;
    }
    const double force =
        std::max({external_.norm(), solid.force.norm(), old.solid.force.norm(),
                  1e-15 * rule.c_a * (model_.mass.array() * solid.u.array()).matrix().norm() /
                      settings_.tolerance});
    const double balance = force > 0.0 ? R_u_.norm() / force : R_u_.norm();
    const double exchange =
        std::max(exchanged_.norm(), 1e-15 * std::sqrt(rounding) / settings_.tolerance);
    return std::max(balance, exchange > 0.0 ? R_p_.norm() / exchange : 0.0);
}

NewtonOutcome CoupledStep::take(const std::vector<materials::Law>& laws, const Newmark& newmark,
                                double dt, double end, const CoupledMotion& old,
                                CoupledMotion& trial) {
    using End = NewtonOutcome::End;
    const auto [beta, gamma] = newmark;
    const TimeRule rule{1.0 / (beta * dt * dt), gamma / (beta * dt)};
    u_predicted_ = old.solid.u + dt * old.solid.v + dt * dt * (0.5 - beta) * old.solid.a;
    v_predicted_ = old.solid.v + dt * (1.0 - gamma) * old.solid.a;
    external_ = model_.external_force;
    if (base_.dashpot.size() > 0) base_.add_force(end, external_);
    trial.solid.u = old.solid.u;
    trial.p = old.p;
    bool renew = !has_matrix_ || rule.c_a != rule_.c_a || rule.c_v != rule_.c_v;
    double before = 0.0;
    for (int iteration = 0;; ++iteration) {
        if (renew) solid_.clear();
        const Geometry geometry =
            renew ? internal_force_.evaluate(laws, old.solid, trial.solid, solid_)
                  : internal_force_.evaluate(laws, old.solid, trial.solid);
        if (geometry == Geometry::degenerate || (renew && !renew_matrix(rule, gamma * dt))) {
            has_matrix_ = false;
            return {End::degenerate, iteration, before};
        }
        const double residual = set_residuals(rule, old, trial, newmark, dt);
        if (residual <= settings_.tolerance) return {End::converged, iteration, residual};
        if (!std::isfinite(residual) || iteration >= settings_.largest_iterations) {
            has_matrix_ = false;
            return {End::not_converged, iteration, residual};
        }
        renew = iteration > 0 && residual > 0.3 * before;
        before = residual;
        ++counts_.iterations;
        const Stopwatch watch(seconds_.solve);
        system_.solve(R_u_, R_p_, d_u_, d_p_);
        trial.solid.u += d_u_;
        trial.p += d_p_;
    }
}

}  // namespace breach::fem
