// Sparse matrix of the unknowns: the pattern is found once, values are added element by element,
// Eigen factorises. With unknown pressures it is symmetric quasi-definite:
//   [  A_u  -Q   ]
//   [ -Q^T  -B_p ]   with A_u = K + c_v C + c_a M and B_p = (S / (gamma dt) + H) / c_v:
// LDL^T needs no pivoting. Each factorisation checks that there are as many positive pivots as
// displacements and as many negative ones as pressures.
// Newton owns one per stage, and a second one of elastic stiffness where there is
// stiffness-proportional damping.
#pragma once

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <Eigen/SparseLU>
#include <span>
#include <vector>

#include "fem_solver/model/model.hpp"

namespace breach::fem {

/// symmetric: lower triangle, LDL^T; general: all entries, LU (displacements only).
enum class Symmetry { symmetric, general };

enum class Factorisation {
    done,
    wrong_sign,  ///< a pivot is zero or has the wrong sign: do not use the factors
    failed,
};

/// Acceleration, velocity and pressure rate as functions of the unknowns:
///   a = c_a (u - u_predicted),  v = v_predicted + c_v (u - u_predicted)        (Newmark 1959)
///   p' = p'_predicted + (p - p_old) / (gamma dt),  gamma dt = c_v / c_a
/// Static step: c_a = c_v = 0. Undrained static step: c_a = 0 and c_v = 1/s, so that volumes of
/// soil and water are increments.
struct TimeRule {
    double c_a = 0.0;  ///< 1 / (beta dt^2) [1/s2]
    double c_v = 0.0;  ///< gamma / (beta dt) [1/s]

    bool is_static() const { return c_a == 0.0; }
    double gamma_dt() const { return is_static() ? 1.0 / c_v : c_v / c_a; }  ///< [s]
};

class LinearSystem {
  public:
    LinearSystem(const Model& model, Unknowns unknowns, Symmetry symmetry);

    Symmetry symmetry() const { return symmetry_; }
    const Unknowns& unknowns() const { return unknowns_; }
    void clear();
    void add_element(std::size_t element, const Stiffness& K);
    /// Adds `factor` times a diagonal, given per dof.
    void add_diagonal(double factor, const Eigen::VectorXd& per_dof);
    /// Adds the blocks -Q and -B_p of the saturated elements, if pressures are unknown.
    void add_water(const TimeRule& rule);
    Factorisation factorise();
    /// y += factor A x, x and y per dof; symmetric systems without pressures only.
    void add_product(double factor, const Eigen::VectorXd& x, Eigen::VectorXd& y);
    /// Solves A x = r; both over the unknowns.
    void solve(const Eigen::VectorXd& r, Eigen::VectorXd& x);
    void copy_diagonal(Eigen::VectorXd& diagonal) const;

    /// Values of the matrix: a resumed run repeats the same factorisation.
    std::span<double> values() { return {A_.valuePtr(), static_cast<std::size_t>(A_.nonZeros())}; }
    std::span<const double> values() const {
        return {A_.valuePtr(), static_cast<std::size_t>(A_.nonZeros())};
    }

  private:
    using Sparse = Eigen::SparseMatrix<double>;

    template <typename Visit>
    void visit_elements(Visit visit) const;
    template <typename Visit>
    void visit_water(Visit visit) const;

    const Model& model_;
    Symmetry symmetry_;
    Unknowns unknowns_;
    Sparse A_;
    std::vector<std::int32_t> place_;     ///< [elements * 64] index into the values, -1: none
    std::vector<std::int32_t> of_water_;  ///< [saturated elements * 48] the same of Q, then B_p
    std::vector<std::int32_t> diagonal_;  ///< [unknowns]
    Eigen::SimplicialLDLT<Sparse, Eigen::Lower, Eigen::AMDOrdering<int>> ldlt_;
    Eigen::SparseLU<Sparse, Eigen::COLAMDOrdering<int>> lu_;
    Eigen::VectorXd product_in_, product_out_;
};

}  // namespace breach::fem
