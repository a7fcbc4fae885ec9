#include "fem_solver/newton.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace breach::fem {
namespace {

/// A new factorisation costs about as much as this many iterations with the old one.
constexpr double worth_of_matrix = 4.0;

}  // namespace

Newton::Newton(const Model& model, NewtonSettings settings, Symmetry symmetry, Seconds& seconds)
    : model_(model),
      settings_(settings),
      seconds_(seconds),
      internal_force_(model, seconds),
      matrix_(model, symmetry) {
    if (model.rayleigh.stiffness > 0.0) {
        elastic_.emplace(model, Symmetry::symmetric);
        elastic_->clear();
        internal_force_.add_elastic_stiffness(1.0, *elastic_);
    }
    R_ = correction_ = plain_ = last_plain_ = last_correction_ =
        Eigen::VectorXd::Zero(model.dofs());
    for (int k = 0; k < depth; ++k) d_plain_[k] = d_u_[k] = R_;
}

NewtonMemory Newton::memory() const {
    NewtonMemory copy = memory_;
    const auto values = matrix_.values();
    copy.values.assign(values.begin(), values.end());
    return copy;
}

void Newton::restore(const NewtonMemory& memory) {
    memory_ = memory;
    if (!memory.has_matrix) return;
    std::ranges::copy(memory.values, matrix_.values().begin());
    memory_.has_matrix = matrix_.factorise() == Factorisation::done;
}

void Newton::add_inertia(const TimeRule& rule) {
    const double from_damping = rule.c_v * model_.rayleigh.mass;
    if (rule.c_a + from_damping > 0.0) matrix_.add_diagonal(rule.c_a + from_damping, model_.mass);
    if (rule.c_v > 0.0 && elastic_) {
        internal_force_.add_elastic_stiffness(rule.c_v * model_.rayleigh.stiffness, matrix_);
    }
}

/// Factorises the assembled tangent; one that is not positive definite would lead uphill, then the
/// elastic one is used.
bool Newton::factorise(const TimeRule& rule) {
    const Stopwatch watch(seconds_.solve);
    ++counts_.factorisations;
    Factorisation result = matrix_.factorise();
    if (result != Factorisation::done) {
        ++counts_.elastic_fallbacks;
        ++counts_.factorisations;
        matrix_.clear();
        internal_force_.add_elastic_stiffness(1.0, matrix_);
        add_inertia(rule);
        result = matrix_.factorise();
    }
    memory_.has_matrix = result == Factorisation::done;
    memory_.rule = rule;
    remembered_ = next_ = 0;
    has_last_ = false;
    return memory_.has_matrix;
}

Geometry Newton::evaluate(const Problem& problem, Motion& trial, Matrix matrix) {
    if (matrix == Matrix::keep) {
        return internal_force_.evaluate(problem.laws, problem.old, trial);
    }
    matrix_.clear();
    const Geometry geometry = internal_force_.evaluate(problem.laws, problem.old, trial, matrix_);
    if (geometry == Geometry::degenerate) {
        memory_.has_matrix = false;
        return geometry;
    }
    add_inertia(problem.rule);
    if (!factorise(problem.rule)) return Geometry::degenerate;
    return geometry;
}

/// R = load f_ext - f_int - M a - C v, zero at held dofs.
void Newton::set_residual(const Problem& problem, Motion& trial) {
    const TimeRule& rule = problem.rule;
    trial.a = rule.c_a * (trial.u - problem.u_predicted);
    trial.v = problem.v_predicted + rule.c_v * (trial.u - problem.u_predicted);
    R_ = problem.load * model_.external_force - trial.force;
    if (rule.c_a > 0.0) {
        R_.array() -=
            model_.mass.array() * (trial.a.array() + model_.rayleigh.mass * trial.v.array());
        if (elastic_) elastic_->add_product(-model_.rayleigh.stiffness, trial.v, R_);
    }
    for (std::size_t d = 0; d < model_.unknowns.of_dof.size(); ++d) {
        if (model_.unknowns.of_dof[d] < 0) R_[static_cast<Eigen::Index>(d)] = 0.0;
    }
}

/// What the residual is measured against: the weight, or the internal forces where they are larger
/// (no gravity). Never so small that the tolerance asks for less than the round-off of M a = c_a M
/// (u - u_predicted).
double Newton::reference_force(const Problem& problem, const Motion& trial) const {
    constexpr double round_off = 1e-15;
    const double inertia =
        problem.rule.c_a * (model_.mass.array() * trial.u.array()).matrix().norm();
    return std::max({problem.load * model_.external_force.norm(), trial.force.norm(),
                     problem.old.force.norm(), round_off * inertia / settings_.tolerance});
}

/// Combines the plain correction g = A^-1 R with the last ones so that the combination's own g is
/// least (Anderson 1965, in the form of Walker & Ni 2011, Eq. 2.2): with an exact tangent it
/// changes nothing.
void Newton::accelerate() {
    correction_ = plain_;
    if (has_last_) {
        d_plain_[next_] = plain_ - last_plain_;
        d_u_[next_] = last_correction_;
        next_ = (next_ + 1) % depth;
        remembered_ = std::min(remembered_ + 1, depth);
    }
    has_last_ = true;
    last_plain_ = plain_;
    if (remembered_ == 0) return;
    Eigen::Matrix<double, depth, depth> gram = Eigen::Matrix<double, depth, depth>::Identity();
    Eigen::Matrix<double, depth, 1> right = Eigen::Matrix<double, depth, 1>::Zero();
    for (int i = 0; i < remembered_; ++i) {
        for (int j = 0; j < remembered_; ++j) gram(i, j) = d_plain_[i].dot(d_plain_[j]);
        right[i] = d_plain_[i].dot(plain_);
    }
    double largest = 0.0;
    for (int i = 0; i < remembered_; ++i) largest = std::max(largest, gram(i, i));
    for (int i = 0; i < remembered_; ++i) gram(i, i) += 1e-14 * largest;
    const Eigen::Matrix<double, depth, 1> share = gram.ldlt().solve(right);
    if (!share.allFinite()) return;
    for (int i = 0; i < remembered_; ++i) correction_ -= share[i] * (d_u_[i] + d_plain_[i]);
}

void Newton::correct(Motion& trial) {
    const Stopwatch watch(seconds_.solve);
    matrix_.solve(R_, plain_);
    accelerate();
    last_correction_ = correction_;
    trial.u += correction_;
}

NewtonOutcome Newton::solve(const std::vector<materials::Law>& laws, const Motion& old,
                            const TimeRule& rule, double load, const Eigen::VectorXd& u_predicted,
                            const Eigen::VectorXd& v_predicted, Motion& trial) {
    using End = NewtonOutcome::End;
    const Problem problem{laws, old, rule, load, u_predicted, v_predicted};
    const bool same_rule = rule.c_a == memory_.rule.c_a && rule.c_v == memory_.rule.c_v;
    const bool serves = memory_.has_matrix && same_rule &&
                        memory_.last_iterations <= static_cast<int>(2.0 * worth_of_matrix);
    remembered_ = next_ = 0;
    has_last_ = false;
    Matrix matrix = serves ? Matrix::keep : Matrix::renew;
    double first = 0.0, before = 0.0, residual = 0.0;
    for (int iteration = 0;; ++iteration) {
        if (evaluate(problem, trial, matrix) == Geometry::degenerate) {
            return {End::degenerate, iteration, residual};
        }
        set_residual(problem, trial);
        const double reference = reference_force(problem, trial);
        const double out_of_balance = R_.norm();
        residual = reference > 0.0 ? out_of_balance / reference : out_of_balance;
        if (residual <= settings_.tolerance) {
            memory_.last_iterations = iteration;
            return {End::converged, iteration, residual};
        }
        if (iteration == 0) first = std::max(residual, settings_.tolerance);
        const bool lost = !std::isfinite(residual) || residual > 1e4 * first;
        if (lost || iteration >= settings_.largest_iterations) {
            memory_.has_matrix = false;
            return {End::not_converged, iteration, residual};
        }
        // Iterations that the present rate of convergence would still need.
        const double rate = iteration == 0 ? 0.1 : residual / before;
        const double wanted = std::log(settings_.tolerance / residual);
        const bool slow = rate >= 1.0 || wanted / std::log(rate) > 2.0 * worth_of_matrix;
        matrix = slow ? Matrix::renew : Matrix::keep;
        before = residual;
        ++counts_.iterations;
        correct(trial);
    }
}

}  // namespace breach::fem
