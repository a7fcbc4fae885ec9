// The order of an iteration: stresses and forces (evaluate), residual (balance), tests of its end,
// correction with the kept matrix or a new one. `trial` is always the last evaluated state,
// converged or not.
#include "fem_solver/solve/newton.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "fem_solver/solve/ranges.hpp"

namespace breach::fem {
namespace {

/// Cost of a factorisation in iterations with an old one.
constexpr double worth_of_matrix = 4.0;
constexpr double round_off = 1e-15;

Unknowns displacements_only(Unknowns unknowns) {
    unknowns.of_pressure.clear();
    unknowns.count = unknowns.displacements;
    return unknowns;
}

/// Thickness of the body over that of each dof's thickest element: without it the forces of
/// free-field columns would dominate the residual.
Eigen::VectorXd shares_of_dofs(const Model& model, const Unknowns& unknowns) {
    std::vector<double> largest(static_cast<std::size_t>(unknowns.count), 1.0);
    for (std::size_t e = model.body.elements; e < model.mesh.quads.size(); ++e) {
        const double times = model.thickness_of(e) / model.thickness;
        for (const std::int32_t node : model.mesh.quads[e]) {
            for (std::size_t d = 0; d < 2; ++d) {
                const std::int32_t i = unknowns.of_dof[2 * static_cast<std::size_t>(node) + d];
                if (i >= 0) largest[i] = std::max(largest[i], times);
            }
            if (unknowns.of_pressure.empty() || unknowns.of_pressure[node] < 0) continue;
            double& of_p = largest[unknowns.of_pressure[node]];
            of_p = std::max(of_p, times);
        }
    }
    Eigen::VectorXd share(unknowns.count);
    for (std::int32_t i = 0; i < unknowns.count; ++i) share[i] = 1.0 / largest[i];
    return share;
}

/// PM4Sand is discontinuous at a reversal (by up to 0.3 % of the mean stress, measured): there, no
/// displacement has a vanishing residual. Such a step is accepted up to this multiple of the
/// tolerance. The unbalanced force enters the next step; it does not accumulate.
constexpr double worst_jump = 100.0;

/// Share of the elastic stiffness added at a limit state.
constexpr double elastic_share = 0.05;
/// Multiple of the tolerance accepted at a limit state.
constexpr double grace = 100.0;

/// Residuals of one step: detects when they stop decreasing.
/// Stalled: after at least six iterations, the best residual has not halved in the last four.
class Progress {
  public:
    void note(double residual) {
        without_better_ = residual < best_ ? 0 : without_better_ + 1;
        best_ = std::min(best_, residual);
        earlier_[noted_++ % window] = best_;
    }
    int without_better() const { return without_better_; }
    bool stalled() const { return noted_ > least && best_ > 0.5 * earlier_[noted_ % window]; }
    double best() const { return best_; }

  private:
    static constexpr std::size_t window = 4, least = 6;
    double best_ = std::numeric_limits<double>::infinity();
    std::array<double, window> earlier_{};
    std::size_t noted_ = 0;
    int without_better_ = 0;
};

}  // namespace

Newton::Newton(const Model& model, Solved solved, NewtonSettings settings, Symmetry symmetry,
               Seconds& seconds)
    : model_(model),
      settings_(settings),
      seconds_(seconds),
      team_(std::make_shared<numerics::Team>(settings.threads)),
      internal_force_(model, seconds, team_),
      matrix_(model, model.unknowns(solved), symmetry) {
    const Unknowns& unknowns = matrix_.unknowns();
    if (model.rayleigh.stiffness > 0.0) {
        elastic_.emplace(model, displacements_only(unknowns), Symmetry::symmetric);
        elastic_->clear();
        internal_force_.add_elastic_stiffness(1.0, *elastic_);
    }
    R_u_ = Eigen::VectorXd::Zero(model.dofs());
    if (internal_force_.is_viscous()) viscous_ = R_u_;
    R_p_ = exchanged_ = Eigen::VectorXd::Zero(model.water.prescribed.size());
    share_ = shares_of_dofs(model, unknowns);
    if (model.body.elements < model.mesh.quads.size()) {
        share_of_dof_ = Eigen::VectorXd::Zero(model.dofs());
        for (std::size_t d = 0; d < unknowns.of_dof.size(); ++d) {
            const std::int32_t i = unknowns.of_dof[d];
            if (i >= 0) share_of_dof_[static_cast<Eigen::Index>(d)] = share_[i];
        }
    }
    residual_ = metric_ = correction_ = plain_ = last_plain_ = last_correction_ =
        Eigen::VectorXd::Zero(unknowns.count);
    for (int k = 0; k < depth; ++k) d_plain_[k] = d_x_[k] = residual_;
}

/// Values of the matrix and not its factors: factorising the same values again gives the same
/// factors.
NewtonMemory Newton::memory() const {
    NewtonMemory copy = memory_;
    const auto values = matrix_.values();
    copy.values.assign(values.begin(), values.end());
    return copy;
}

bool Newton::restore(const NewtonMemory& memory) {
    if (memory.has_matrix && memory.values.size() != matrix_.values().size()) return false;
    memory_ = memory;
    if (!memory.has_matrix) return true;
    const Stopwatch watch(seconds_, &Seconds::factor);
    std::ranges::copy(memory.values, matrix_.values().begin());
    memory_.has_matrix = matrix_.factorise() == Factorisation::done;
    matrix_.copy_diagonal(metric_);
    metric_.array() *= share_.array();
    return true;
}

void Newton::add_inertia_and_water(const TimeRule& rule) {
    if (rule.c_v == 0.0) return;
    if (!rule.is_static()) {
        matrix_.add_diagonal(rule.c_a + rule.c_v * model_.rayleigh.mass, model_.mass);
        if (model_.base.any()) matrix_.add_diagonal(rule.c_v, model_.base.dashpot);
        if (elastic_) {
            internal_force_.add_elastic_stiffness(rule.c_v * model_.rayleigh.stiffness, matrix_);
        }
        if (viscous_.size() > 0) internal_force_.add_viscous_damping(rule.c_v, matrix_);
    }
    matrix_.add_water(rule);
}

/// Factorises the assembled tangent; the elastic one if that is not positive definite.
bool Newton::factorise(const TimeRule& rule) {
    const Stopwatch watch(seconds_, &Seconds::factor);
    ++counts_.factorisations;
    Factorisation result = matrix_.factorise();
    if (result != Factorisation::done) {
        ++counts_.elastic_fallbacks;
        ++counts_.factorisations;
        matrix_.clear();
        internal_force_.add_elastic_stiffness(1.0, matrix_);
        add_inertia_and_water(rule);
        result = matrix_.factorise();
    }
    matrix_.copy_diagonal(metric_);
    metric_.array() *= share_.array();
    memory_.has_matrix = result == Factorisation::done;
    memory_.rule = rule;
    remembered_ = next_ = 0;
    has_last_ = false;
    return memory_.has_matrix;
}

std::string Newton::why_degenerate() const {
    if (unsolvable_) return "the matrix cannot be factorised, not even that of elastic soil";
    return internal_force_.why_degenerate();
}

Geometry Newton::evaluate(const StepProblem& problem, Motion& trial, Matrix matrix) {
    unsolvable_ = false;
    if (matrix == Matrix::keep) {
        return internal_force_.evaluate(problem.laws, problem.old, trial);
    }
    matrix_.clear();
    const Geometry geometry = internal_force_.evaluate(problem.laws, problem.old, trial, matrix_);
    if (geometry == Geometry::degenerate) {
        memory_.has_matrix = false;
        return geometry;
    }
    {
        const Stopwatch watch(seconds_, &Seconds::assembly);
        // At a limit state the laws' tangents are singular. A part of the elastic stiffness makes
        // iterations slower and finite; equilibrium is judged by forces and not by the matrix.
        if (tangent_ == Tangent::stiffened)
            internal_force_.add_elastic_stiffness(elastic_share, matrix_);
        add_inertia_and_water(problem.rule);
    }
    unsolvable_ = !factorise(problem.rule);
    return unsolvable_ ? Geometry::degenerate : geometry;
}

void Newton::add_damping_force(double factor, const Eigen::VectorXd& v, Eigen::VectorXd& f) {
    f.array() += factor * model_.rayleigh.mass * model_.mass.array() * v.array();
    if (elastic_) elastic_->add_product(factor * model_.rayleigh.stiffness, v, f);
    if (model_.base.any()) f.array() += factor * model_.base.dashpot.array() * v.array();
    internal_force_.add_viscous_force(factor, v, f);
}

/// R_u = f_ext - f_int - M a - C v - f_viscous + Q p;  R_p = flux - Q^T v - S p' - H p.
void Newton::set_residual(const StepProblem& problem, Motion& trial) {
    const TimeRule& rule = problem.rule;
    trial.a = rule.c_a * (trial.u - problem.u_predicted);
    trial.v = problem.v_predicted + rule.c_v * (trial.u - problem.u_predicted);
    R_u_ = problem.external - trial.force;
    if (rule.c_a > 0.0) {
        if (model_.rayleigh.mass > 0.0) {
            R_u_.array() -=
                model_.mass.array() * (trial.a.array() + model_.rayleigh.mass * trial.v.array());
        } else {
            R_u_.array() -= model_.mass.array() * trial.a.array();
        }
        if (elastic_) elastic_->add_product(-model_.rayleigh.stiffness, trial.v, R_u_);
        if (model_.base.any()) R_u_.array() -= model_.base.dashpot.array() * trial.v.array();
        if (viscous_.size() > 0) {
            viscous_.setZero();
            internal_force_.add_viscous_force(1.0, trial.v, viscous_);
            R_u_ -= viscous_;
        }
    }
    if (unknowns().pressures() > 0) add_water(problem, trial);
    gather_residual(problem);
}

void Newton::add_water(const StepProblem& problem, Motion& trial) {
    const TimeRule& rule = problem.rule;
    const double gamma_dt = rule.gamma_dt();
    trial.p_rate = problem.p_rate_predicted + (trial.p - problem.old.p) / gamma_dt;
    R_p_.setZero();
    exchanged_.setZero();
    double rounding = 0.0;
    const auto& elements = model_.water.elements;
    // Shares are computed on the threads, then added in the order of the elements.
    of_water_.resize(elements.size());
    for_ranges(elements.size(), *team_, [&](std::size_t begin, std::size_t end) {
        for (std::size_t e = begin; e < end; ++e) {
            of_water_[e] = water_share(elements[e], problem, trial);
        }
    });
    for (std::size_t e = 0; e < elements.size(); ++e) {
        const Quad& quad = model_.mesh.quads[elements[e].element];
        const WaterShare& share = of_water_[e];
        rounding += share.rounding;
        for (int i = 0; i < 4; ++i) {
            R_u_.segment<2>(2 * static_cast<Eigen::Index>(quad[i])) +=
                share.force.segment<2>(2 * i);
            R_p_[quad[i]] += share.balance[i];
            exchanged_[quad[i]] += share.exchanged[i];
        }
    }
    water_rounding_ = round_off * std::sqrt(rounding);
}

Newton::WaterShare Newton::water_share(const PorousElement& each, const StepProblem& problem,
                                       const Motion& trial) const {
    const TimeRule& rule = problem.rule;
    const Quad& quad = model_.mesh.quads[each.element];
    Eigen::Vector4d p, p_rate;
    for (int i = 0; i < 4; ++i) {
        p[i] = trial.p[quad[i]];
        p_rate[i] = trial.p_rate[quad[i]];
    }
    // Columns count as if they had the body's thickness, here as in share_: their exchange would
    // hide any imbalance of the body.
    const double share = model_.thickness / model_.thickness_of(each.element);
    const Eigen::Vector4d expansion = each.Q.transpose() * gather(quad, trial.v);
    const Eigen::Vector4d stored = each.S * p_rate, conducted = each.H * p;
    const double of_u = rule.c_v * each.Q.col(0).cwiseAbs().dot(gather(quad, trial.u).cwiseAbs());
    const double of_p =
        (each.S.row(0).cwiseAbs() / rule.gamma_dt() + each.H.row(0).cwiseAbs()).dot(p.cwiseAbs());
    return {.force = each.Q * p,
            .balance = each.flux - expansion - stored - conducted,
            .exchanged = share * (each.flux.cwiseAbs() + expansion.cwiseAbs() + stored.cwiseAbs() +
                                  conducted.cwiseAbs()),
            .rounding = share * share * (of_u + of_p) * (of_u + of_p)};
}

/// Sums over ties; fixed dofs drop out. The mass balance is divided by -c_v, like its rows.
void Newton::gather_residual(const StepProblem& problem) {
    residual_.setZero();
    if (model_.row_weight.size() > 0) R_u_.array() *= model_.row_weight.array();
    const Unknowns& n = unknowns();
    for (std::size_t d = 0; d < n.of_dof.size(); ++d) {
        if (n.of_dof[d] >= 0) residual_[n.of_dof[d]] += R_u_[static_cast<Eigen::Index>(d)];
    }
    const double c_v = problem.rule.c_v;
    for (std::size_t i = 0; i < n.of_pressure.size(); ++i) {
        const std::int32_t row = n.of_pressure[i];
        if (row >= 0) residual_[row] -= R_p_[static_cast<Eigen::Index>(i)] / c_v;
    }
}

double Newton::norm_of(const Eigen::VectorXd& per_dof) const {
    if (share_of_dof_.size() == 0) return per_dof.norm();
    return (share_of_dof_.array() * per_dof.array()).matrix().norm();
}

/// Unbalanced force over the weight, or over the internal or viscous forces if larger (no gravity);
/// unbalanced over exchanged volume. The reference includes round-off, as M a is c_a M (u -
/// u_predicted).
double Newton::residual_measure(const StepProblem& problem, const Motion& trial) const {
    const std::int32_t n_u = unknowns().displacements, n_p = unknowns().pressures();
    const double inertia =
        problem.rule.c_a > 0.0
            ? problem.rule.c_a * (model_.mass.array() * trial.u.array()).matrix().norm()
            : 0.0;
    const double viscous = viscous_.size() > 0 ? norm_of(viscous_) : 0.0;
    const double reference =
        std::max({norm_of(problem.external), norm_of(trial.force), norm_of(problem.old.force),
                  viscous, round_off * inertia / settings_.tolerance});
    const double force = residual_.head(n_u).cwiseProduct(share_.head(n_u)).norm();
    const double of_force = reference > 0.0 ? force / reference : force;
    if (n_p == 0) return of_force;
    const double exchange = std::max(exchanged_.norm(), water_rounding_ / settings_.tolerance);
    const double volume =
        problem.rule.c_v * residual_.tail(n_p).cwiseProduct(share_.tail(n_p)).norm();
    return std::max(of_force, exchange > 0.0 ? volume / exchange : 0.0);
}

/// Combines the correction g = A^-1 R with the last ones to minimise the combination's own g
/// (Anderson 1965, as in Walker & Ni 2011, Eq. 2.2) in the norm of the matrix's diagonal. Has no
/// effect with an exact tangent.
void Newton::accelerate() {
    correction_ = plain_;
    if (has_last_) {
        d_plain_[next_] = plain_ - last_plain_;
        d_x_[next_] = last_correction_;
        next_ = (next_ + 1) % depth;
        remembered_ = std::min(remembered_ + 1, depth);
    }
    has_last_ = true;
    last_plain_ = plain_;
    if (remembered_ == 0) return;
    const auto dot = [this](const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
        return (metric_.array() * a.array() * b.array()).sum();
    };
    Eigen::Matrix<double, depth, depth> gram = Eigen::Matrix<double, depth, depth>::Identity();
    Eigen::Matrix<double, depth, 1> right = Eigen::Matrix<double, depth, 1>::Zero();
    for (int i = 0; i < remembered_; ++i) {
        for (int j = 0; j <= i; ++j) gram(i, j) = gram(j, i) = dot(d_plain_[i], d_plain_[j]);
        right[i] = dot(d_plain_[i], plain_);
    }
    double largest = 0.0;
    for (int i = 0; i < remembered_; ++i) largest = std::max(largest, gram(i, i));
    for (int i = 0; i < remembered_; ++i) gram(i, i) += 1e-14 * largest;
    const Eigen::Matrix<double, depth, 1> share = gram.ldlt().solve(right);
    if (!share.allFinite()) return;
    for (int i = 0; i < remembered_; ++i) correction_ -= share[i] * (d_x_[i] + d_plain_[i]);
}

void Newton::correct(Motion& trial) {
    const Stopwatch watch(seconds_, &Seconds::solve);
    matrix_.solve(residual_, plain_);
    accelerate();
    last_correction_ = correction_;
    const Unknowns& n = unknowns();
    for (std::size_t d = 0; d < n.of_dof.size(); ++d) {
        if (n.of_dof[d] >= 0) trial.u[static_cast<Eigen::Index>(d)] += correction_[n.of_dof[d]];
    }
    for (std::size_t i = 0; i < n.of_pressure.size(); ++i) {
        const std::int32_t row = n.of_pressure[i];
        if (row >= 0) trial.p[static_cast<Eigen::Index>(i)] += correction_[row];
    }
}

double Newton::balance(const StepProblem& problem, Motion& trial) {
    const Stopwatch watch(seconds_, &Seconds::assembly);
    set_residual(problem, trial);
    return residual_measure(problem, trial);
}

NewtonOutcome Newton::solve(const StepProblem& problem, Motion& trial) {
    using End = NewtonOutcome::End;
    const TimeRule& rule = problem.rule;
    const bool same_rule = rule.c_a == memory_.rule.c_a && rule.c_v == memory_.rule.c_v;
    // A matrix that needed more iterations than two factorisations cost is renewed at once.
    const bool serves = memory_.has_matrix && same_rule &&
                        memory_.last_iterations <= static_cast<int>(2.0 * worth_of_matrix);
    remembered_ = next_ = 0;
    has_last_ = false;
    Matrix matrix = serves ? Matrix::keep : Matrix::renew;
    double first = 0.0, before = 0.0, residual = 0.0;
    // With laws with memory the matrix depends on the step's ends: a second renewal would give the
    // same.
    const bool of_ends = !problem.old.memory.empty();
    int renewals_left = of_ends ? 1 : settings_.largest_iterations;
    Progress progress;
    for (int iteration = 0;; ++iteration) {
        if (evaluate(problem, trial, matrix) == Geometry::degenerate) {
            return {End::degenerate, iteration, residual};
        }
        residual = balance(problem, trial);
        if (residual <= settings_.tolerance) {
            memory_.last_iterations = iteration;
            return {End::converged, iteration, residual};
        }
        progress.note(residual);
        if (of_ends && progress.stalled() && residual <= 2.0 * progress.best() &&
            residual <= worst_jump * settings_.tolerance) {
            ++counts_.stalled;
            return {End::converged, iteration, residual};
        }
        const bool near_limit =
            tangent_ == Tangent::stiffened && residual <= grace * settings_.tolerance;
        if (near_limit && progress.stalled()) return {End::converged, iteration, residual};
        if (iteration == 0) first = std::max(residual, settings_.tolerance);
        // Diverged: the caller cuts the step, which costs less than the remaining iterations.
        const bool lost = !std::isfinite(residual) || residual > 1e4 * first;
        if (lost || iteration >= settings_.largest_iterations ||
            progress.without_better() > settings_.patience) {
            memory_.has_matrix = false;
            return {near_limit ? End::converged : End::not_converged, iteration, residual};
        }
        // Iterations still needed at the present rate of convergence, unknown before the first
        // correction.
        const double rate = iteration == 0 ? 0.0 : residual / before;
        const double wanted = std::log(settings_.tolerance / residual);
        const bool slow =
            rate >= 1.0 || (rate > 0.0 && wanted / std::log(rate) > 2.0 * worth_of_matrix);
        // Slow: the matrix is renewed if the rest at this rate costs more than two factorisations.
        const bool worth = slow && (!of_ends || residual > worst_jump * settings_.tolerance);
        matrix = worth && renewals_left-- > 0 ? Matrix::renew : Matrix::keep;
        before = residual;
        ++counts_.iterations;
        correct(trial);
    }
}

}  // namespace breach::fem
