// The symmetric quasi-definite matrix of skeleton and pore water:
//   [  A_u  -Q   ]
//   [ -Q^T  -B_p ]   with A_u = K + c_v C + c_a M and B_p = (S / (gamma dt) + H) / c_v.
// LDL^T needs no pivoting; it has as many positive pivots as displacements and as many negative
// ones as pressures, which each factorisation checks.
#pragma once

#include "fem_solver/linear_system.hpp"
#include "fem_solver/newton.hpp"
#include "fem_solver/pore_water.hpp"

namespace breach::fem {

class CoupledSystem {
  public:
    /// `solid` is a symmetric system over the model's displacements.
    CoupledSystem(const Model& model, const PoreWater& water, const LinearSystem& solid);

    /// Takes A_u from `solid`, adds the water for this rule and factorises.
    Factorisation factorise(const LinearSystem& solid, const TimeRule& rule, double gamma_dt);
    /// R_u: [dofs] N; R_p: [nodes] m3/s, the residual of the mass balance before its division by
    /// -c_v.
    void solve(const Eigen::VectorXd& R_u, const Eigen::VectorXd& R_p, Eigen::VectorXd& d_u,
               Eigen::VectorXd& d_p);

  private:
    using Sparse = Eigen::SparseMatrix<double>;

    template <typename Add>
    void visit_water(const TimeRule& rule, double gamma_dt, Add add) const;

    const Model& model_;
    const PoreWater& water_;
    std::int32_t n_u_;
    Sparse A_;
    std::vector<std::int32_t> place_of_solid_;  ///< of each stored entry of A_u
    std::vector<std::int32_t> place_of_water_;  ///< in the order of visit_water
    Eigen::SimplicialLDLT<Sparse, Eigen::Lower, Eigen::AMDOrdering<int>> ldlt_;
    Eigen::VectorXd right_, solution_, scale_;
    double c_v_ = 0.0;
};

}  // namespace breach::fem
