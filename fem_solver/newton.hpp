// Equilibrium at the end of a step: M a + C v + f_int(u) = f_ext by Newton's method with a
// factorisation that is kept as long as it serves, accelerated (Anderson 1965) over the last few
// corrections.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "fem_solver/internal_force.hpp"

namespace breach::fem {

/// How acceleration and velocity hang on the displacement that is sought:
///   a = c_a (u - u_predicted),  v = v_predicted + c_v (u - u_predicted)        (Newmark 1959)
/// A static step has c_a = c_v = 0.
struct TimeRule {
    double c_a = 0.0;  ///< 1 / (beta dt^2) [1/s2]
    double c_v = 0.0;  ///< gamma / (beta dt) [1/s]
};

struct NewtonSettings {
    double tolerance;  ///< out-of-balance force over reference force [-]
    int largest_iterations;
};

struct NewtonOutcome {
    enum class End { converged, not_converged, degenerate };
    End end;
    int iterations;
    double residual;  ///< out-of-balance over reference force [-]
};

/// Counts over a whole run.
struct NewtonCounts {
    std::int64_t iterations = 0;
    std::int64_t factorisations = 0;
    std::int64_t elastic_fallbacks = 0;  ///< tangents that were not positive definite
};

/// What the next step inherits from the last one: saved in a checkpoint so that a resumed run does
/// the same.
struct NewtonMemory {
    bool has_matrix = false;
    TimeRule rule;  ///< of the matrix
    int last_iterations = 0;
    std::vector<double> values;  ///< assembled matrix
};

class Newton {
  public:
    Newton(const Model& model, NewtonSettings settings, Symmetry symmetry, Seconds& seconds);

    /// Finds trial.u (starting from the value it has), fills trial.points, strain, force, v, a.
    /// load: share of the external force in place [-]. u_predicted, v_predicted per dof.
    NewtonOutcome solve(const std::vector<materials::Law>& laws, const Motion& old,
                        const TimeRule& rule, double load, const Eigen::VectorXd& u_predicted,
                        const Eigen::VectorXd& v_predicted, Motion& trial);
    /// The next solve starts with a new factorisation.
    void forget_matrix() { memory_.has_matrix = false; }

    const NewtonCounts& counts() const { return counts_; }
    void set_counts(const NewtonCounts& counts) { counts_ = counts; }
    NewtonMemory memory() const;
    void restore(const NewtonMemory& memory);
    InternalForce& internal_force() { return internal_force_; }

  private:
    static constexpr int depth = 5;  ///< corrections remembered by the acceleration

    struct Problem {
        const std::vector<materials::Law>& laws;
        const Motion& old;
        const TimeRule& rule;
        double load;
        const Eigen::VectorXd& u_predicted;
        const Eigen::VectorXd& v_predicted;
    };
    enum class Matrix { keep, renew };

    Geometry evaluate(const Problem& problem, Motion& trial, Matrix matrix);
    bool factorise(const TimeRule& rule);
    void add_inertia(const TimeRule& rule);
    void set_residual(const Problem& problem, Motion& trial);
    double reference_force(const Problem& problem, const Motion& trial) const;
    void correct(Motion& trial);
    void accelerate();

    const Model& model_;
    NewtonSettings settings_;
    Seconds& seconds_;
    InternalForce internal_force_;
    LinearSystem matrix_;
    std::optional<LinearSystem> elastic_;  ///< only with stiffness-proportional damping
    NewtonMemory memory_;                  ///< values stay in matrix_
    NewtonCounts counts_;
    Eigen::VectorXd R_;           ///< out-of-balance force [N]
    Eigen::VectorXd correction_;  ///< [m]
    Eigen::VectorXd plain_, last_plain_, last_correction_;
    std::array<Eigen::VectorXd, depth> d_plain_, d_u_;
    int remembered_ = 0;
    int next_ = 0;
    bool has_last_ = false;
};

}  // namespace breach::fem
