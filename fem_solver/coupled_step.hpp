// One step of skeleton and pore water together over an absorbing base: Newmark for u, its
// first-order analogue for p, Newton with a kept quasi-definite factorisation.
#pragma once

#include "fem_solver/absorbing_base.hpp"
#include "fem_solver/coupled_system.hpp"
#include "fem_solver/step.hpp"

namespace breach::fem {

/// All that a coupled step changes. p, p_rate: [nodes] Pa and Pa/s, zero in dry soil.
struct CoupledMotion {
    Motion solid;
    Eigen::VectorXd p;
    Eigen::VectorXd p_rate;
};

CoupledMotion coupled_at_rest(const Model& model);

class CoupledStep {
  public:
    /// Without water (no saturated element) or base (empty dashpots) their terms are left out.
    CoupledStep(const Model& model, const PoreWater& water, const AbsorbingBase& base,
                NewtonSettings settings, Seconds& seconds);

    /// From `old` over dt to time `end` [s].
    NewtonOutcome take(const std::vector<materials::Law>& laws, const Newmark& newmark, double dt,
                       double end, const CoupledMotion& old, CoupledMotion& trial);
    const NewtonCounts& counts() const { return counts_; }

  private:
    bool renew_matrix(const TimeRule& rule, double gamma_dt);
    double set_residuals(const TimeRule& rule, const CoupledMotion& old, CoupledMotion& trial,
                         const Newmark& newmark, double dt);

    const Model& model_;
    const PoreWater& water_;
    const AbsorbingBase& base_;
    NewtonSettings settings_;
    Seconds& seconds_;
    InternalForce internal_force_;
    LinearSystem solid_;
    std::optional<LinearSystem> elastic_;  ///< only with stiffness-proportional damping
    CoupledSystem system_;
    NewtonCounts counts_;
    TimeRule rule_;  ///< of the matrix
    bool has_matrix_ = false;
    Eigen::VectorXd external_, R_u_, R_p_, exchanged_, d_u_, d_p_, u_predicted_, v_predicted_;
};

}  // namespace breach::fem
