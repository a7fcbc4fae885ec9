// The sparse tangent over the unknowns: pattern found once, values filled element by element,
// factorised by Eigen.
#pragma once

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <Eigen/SparseLU>
#include <span>
#include <vector>

#include "fem_solver/model.hpp"

namespace breach::fem {

/// symmetric: lower triangle, LDL^T; general: all entries, LU.
enum class Symmetry { symmetric, general };

enum class Factorisation {
    done,
    not_positive,  ///< a pivot <= 0: no longer a minimum; the factors exist but are not used
    failed,
};

class LinearSystem {
  public:
    LinearSystem(const Model& model, Symmetry symmetry);

    Symmetry symmetry() const { return symmetry_; }
    void clear();
    void add_element(std::size_t element, const Stiffness& K);
    /// Adds `factor` times a diagonal given per dof.
    void add_diagonal(double factor, const Eigen::VectorXd& per_dof);
    Factorisation factorise();
    /// y += factor A x over the unknowns, per dof; symmetric systems only.
    void add_product(double factor, const Eigen::VectorXd& x, Eigen::VectorXd& y);
    /// Solves A x = r over the unknowns; r and x are per dof, x = 0 at held dofs.
    void solve(const Eigen::VectorXd& r, Eigen::VectorXd& x);

    /// The assembled values, so that a resumed run can repeat the same factorisation.
    std::span<double> values() { return {A_.valuePtr(), static_cast<std::size_t>(A_.nonZeros())}; }
    std::span<const double> values() const {
        return {A_.valuePtr(), static_cast<std::size_t>(A_.nonZeros())};
    }

    /// Lower triangle of a symmetric system, all of a general one.
    const Eigen::SparseMatrix<double>& matrix() const { return A_; }

  private:
    using Sparse = Eigen::SparseMatrix<double>;

    Symmetry symmetry_;
    const Unknowns& unknowns_;
    Sparse A_;
    std::vector<std::int32_t> place_;     ///< [elements * 64] index into the values, -1: not stored
    std::vector<std::int32_t> diagonal_;  ///< [unknowns]
    Eigen::SimplicialLDLT<Sparse, Eigen::Lower, Eigen::AMDOrdering<int>> ldlt_;
    Eigen::SparseLU<Sparse, Eigen::COLAMDOrdering<int>> lu_;
    Eigen::VectorXd right_, solution_;
};

}  // namespace breach::fem
