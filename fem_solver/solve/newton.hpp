// Equilibrium and mass balance at the end of a step,
//     M a + C v + f_int(u) + f_viscous(v) - Q p = f_ext,   Q^T v + S p' + H p = flux,
// by Newton's method. A factorisation is kept while it converges, with Anderson acceleration (1965)
// over the last corrections. Without unknown pressures there is no second equation.
// One per stage (Course::make_newton). Steps call solve(); who wants another step size calls
// forget_matrix().
#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fem_solver/solve/internal_force.hpp"

namespace breach::fem {

struct NewtonSettings {
    double tolerance;  ///< residual over reference [-]
    int largest_iterations;
    int threads = 1;                                 ///< does not change the results
    int patience = std::numeric_limits<int>::max();  ///< iterations without a smaller residual
};

/// degenerate: a law refused the trial, or no matrix could be factorised. The caller cuts the step,
/// as for not_converged, and reports why_degenerate() if it cannot.
struct NewtonOutcome {
    enum class End { converged, not_converged, degenerate };
    End end;
    int iterations;
    /// the larger of unbalanced over reference force and unbalanced over exchanged volume [-]
    double residual;
};

/// Totals of a run.
struct NewtonCounts {
    std::int64_t iterations = 0;
    std::int64_t factorisations = 0;
    std::int64_t elastic_fallbacks = 0;  ///< tangents with a pivot of the wrong sign
    std::int64_t stalled = 0;  ///< steps accepted above the tolerance at a jump of PM4Sand
};

/// What a step takes over from the one before; in the checkpoint, so that a resumed run has the
/// same results.
struct NewtonMemory {
    bool has_matrix = false;
    TimeRule rule;  ///< for which the matrix was assembled
    int last_iterations = 0;
    std::vector<double> values;  ///< assembled matrix
};

/// Beginning and predicted end of a step.
/// Made by static_step and dynamic_step for one solve: it refers to the caller's vectors.
struct StepProblem {
    const std::vector<materials::Law>& laws;
    const Motion& old;
    TimeRule rule;
    const Eigen::VectorXd& external;          ///< force at the end of the step, per dof [N]
    const Eigen::VectorXd& u_predicted;       ///< per dof [m]
    const Eigen::VectorXd& v_predicted;       ///< per dof [m/s]
    const Eigen::VectorXd& p_rate_predicted;  ///< per node [Pa/s]; empty without unknown pressures
};

class Newton {
  public:
    Newton(const Model& model, Solved solved, NewtonSettings settings, Symmetry symmetry,
           Seconds& seconds);

    /// Solves for trial.u and trial.p, starting at their values, and sets the rest of trial.
    NewtonOutcome solve(const StepProblem& problem, Motion& trial);
    /// stiffened: adds a part of the elastic stiffness, for limit states, in which the tangents are
    /// singular. Then a solution within a wider tolerance is accepted when its residual stops
    /// decreasing.
    enum class Tangent { of_the_laws, stiffened };
    void take(Tangent tangent) {
        tangent_ = tangent;
        forget_matrix();
    }
    /// Forces a new factorisation in the next solve.
    void forget_matrix() { memory_.has_matrix = false; }

    const Unknowns& unknowns() const { return matrix_.unknowns(); }
    const NewtonCounts& counts() const { return counts_; }
    void set_counts(const NewtonCounts& counts) { counts_ = counts; }
    NewtonMemory memory() const;
    /// Adds `factor` times C v to f [N]: damping of mass and stiffness, base dashpots, viscosity.
    void add_damping_force(double factor, const Eigen::VectorXd& v, Eigen::VectorXd& f);
    /// False: the stored matrix does not fit this problem; nothing is restored.
    bool restore(const NewtonMemory& memory);
    /// After a degenerate solve: which element, and why.
    std::string why_degenerate() const;
    InternalForce& internal_force() { return internal_force_; }
    const InternalForce& internal_force() const { return internal_force_; }

  private:
    static constexpr int depth = 5;  ///< number of corrections for the acceleration
    enum class Matrix { keep, renew };

    Geometry evaluate(const StepProblem& problem, Motion& trial, Matrix matrix);
    bool factorise(const TimeRule& rule);
    void add_inertia_and_water(const TimeRule& rule);
    double balance(const StepProblem& problem, Motion& trial);
    void set_residual(const StepProblem& problem, Motion& trial);
    void add_water(const StepProblem& problem, Motion& trial);
    void gather_residual(const StepProblem& problem);
    double residual_measure(const StepProblem& problem, const Motion& trial) const;
    double norm_of(const Eigen::VectorXd& per_dof) const;
    void correct(Motion& trial);
    void accelerate();

    const Model& model_;
    NewtonSettings settings_;
    Seconds& seconds_;
    std::shared_ptr<numerics::Team> team_;
    InternalForce internal_force_;
    LinearSystem matrix_;
    std::optional<LinearSystem> elastic_;  ///< for stiffness-proportional damping
    NewtonMemory memory_;                  ///< without values: they are in matrix_
    Tangent tangent_ = Tangent::of_the_laws;
    NewtonCounts counts_;
    Eigen::VectorXd viscous_;    ///< viscous force, per dof; empty without viscosity [N]
    Eigen::VectorXd R_u_;        ///< out-of-balance force, per dof [N]
    Eigen::VectorXd R_p_;        ///< unbalanced volume, per node [m3/s]
    Eigen::VectorXd exchanged_;  ///< sum of the magnitudes of the volume terms [m3/s]
    /// Contribution of a saturated element to the two balances.
    struct WaterShare {
        Dofs8 force;                ///< [N]
        Eigen::Vector4d balance;    ///< [m3/s]
        Eigen::Vector4d exchanged;  ///< [m3/s]
        double rounding;            ///< squared [m6/s2]
    };
    WaterShare water_share(const PorousElement& each, const StepProblem& problem,
                           const Motion& trial) const;
    std::vector<WaterShare> of_water_;  ///< [saturated elements] scratch memory
    double water_rounding_ = 0.0;       ///< round-off of the volume balance [m3/s]
    Eigen::VectorXd share_of_dof_;      ///< 1 / thickness, per dof; empty without thick columns [-]
    Eigen::VectorXd share_;             ///< the same per unknown; 1 without columns
    Eigen::VectorXd residual_;          ///< right side over the unknowns
    Eigen::VectorXd metric_;            ///< scales displacements and pressures to comparable size
    Eigen::VectorXd correction_, plain_, last_plain_, last_correction_;
    std::array<Eigen::VectorXd, depth> d_plain_, d_x_;
    int remembered_ = 0;
    int next_ = 0;
    bool has_last_ = false;
    bool unsolvable_ = false;  ///< the last matrix, even the elastic one, was singular
};

}  // namespace breach::fem
