#include "fem_solver/linear_system.hpp"

#include <algorithm>

namespace breach::fem {
namespace {

std::array<std::int32_t, 8> unknowns_of(const Quad& quad, const Unknowns& unknowns) {
    std::array<std::int32_t, 8> result;
    for (std::size_t k = 0; k < 4; ++k) {
        for (std::size_t d = 0; d < 2; ++d) {
            result[2 * k + d] = unknowns.of_dof[2 * static_cast<std::size_t>(quad[k]) + d];
        }
    }
    return result;
}

bool is_stored(std::int32_t row, std::int32_t column, Symmetry symmetry) {
    return row >= 0 && column >= 0 && (symmetry == Symmetry::general || row >= column);
}

std::int32_t index_of(const Eigen::SparseMatrix<double>& A, std::int32_t row, std::int32_t column) {
    const int* begin = A.innerIndexPtr() + A.outerIndexPtr()[column];
    const int* end = A.innerIndexPtr() + A.outerIndexPtr()[column + 1];
    return static_cast<std::int32_t>(std::lower_bound(begin, end, row) - A.innerIndexPtr());
}

}  // namespace

LinearSystem::LinearSystem(const Model& model, Symmetry symmetry)
    : symmetry_(symmetry), unknowns_(model.unknowns) {
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(model.mesh.quads.size() * 64);
    for (const Quad& quad : model.mesh.quads) {
        const auto n = unknowns_of(quad, unknowns_);
        for (const std::int32_t i : n) {
            for (const std::int32_t j : n) {
                if (is_stored(i, j, symmetry_)) entries.emplace_back(i, j, 1.0);
            }
        }
    }
    A_.resize(unknowns_.count, unknowns_.count);
    A_.setFromTriplets(entries.begin(), entries.end());
    A_.makeCompressed();
    place_.reserve(model.mesh.quads.size() * 64);
    for (const Quad& quad : model.mesh.quads) {
        const auto n = unknowns_of(quad, unknowns_);
        for (const std::int32_t j : n) {
            for (const std::int32_t i : n) {
                place_.push_back(is_stored(i, j, symmetry_) ? index_of(A_, i, j) : -1);
            }
        }
    }
    for (std::int32_t i = 0; i < unknowns_.count; ++i) diagonal_.push_back(index_of(A_, i, i));
    if (symmetry_ == Symmetry::symmetric) {
        ldlt_.analyzePattern(A_);
    } else {
        lu_.analyzePattern(A_);
    }
    right_.resize(unknowns_.count);
    solution_.resize(unknowns_.count);
}

void LinearSystem::clear() { std::ranges::fill(values(), 0.0); }

void LinearSystem::add_element(std::size_t element, const Stiffness& K) {
    const std::int32_t* place = &place_[element * 64];
    double* values = A_.valuePtr();
    for (int entry = 0; entry < 64; ++entry) {
        if (place[entry] >= 0) values[place[entry]] += K.data()[entry];
    }
}

void LinearSystem::add_diagonal(double factor, const Eigen::VectorXd& per_dof) {
    double* values = A_.valuePtr();
    for (std::size_t d = 0; d < unknowns_.of_dof.size(); ++d) {
        const std::int32_t i = unknowns_.of_dof[d];
        if (i >= 0) values[diagonal_[i]] += factor * per_dof[static_cast<Eigen::Index>(d)];
    }
}

Factorisation LinearSystem::factorise() {
    if (symmetry_ == Symmetry::general) {
        lu_.factorize(A_);
        return lu_.info() == Eigen::Success ? Factorisation::done : Factorisation::failed;
    }
    ldlt_.factorize(A_);
    if (ldlt_.info() != Eigen::Success) return Factorisation::failed;
    return (ldlt_.vectorD().array() > 0.0).all() ? Factorisation::done
                                                 : Factorisation::not_positive;
}

void LinearSystem::add_product(double factor, const Eigen::VectorXd& x, Eigen::VectorXd& y) {
    for (std::size_t d = 0; d < unknowns_.of_dof.size(); ++d) {
        const std::int32_t i = unknowns_.of_dof[d];
        if (i >= 0) right_[i] = x[static_cast<Eigen::Index>(d)];
    }
    solution_ = A_.selfadjointView<Eigen::Lower>() * right_;
    for (std::size_t d = 0; d < unknowns_.of_dof.size(); ++d) {
        const std::int32_t i = unknowns_.of_dof[d];
        if (i >= 0) y[static_cast<Eigen::Index>(d)] += factor * solution_[i];
    }
}

void LinearSystem::solve(const Eigen::VectorXd& r, Eigen::VectorXd& x) {
    for (std::size_t d = 0; d < unknowns_.of_dof.size(); ++d) {
        const std::int32_t i = unknowns_.of_dof[d];
        if (i >= 0) right_[i] = r[static_cast<Eigen::Index>(d)];
    }
    if (symmetry_ == Symmetry::symmetric) {
        solution_ = ldlt_.solve(right_);
    } else {
        solution_ = lu_.solve(right_);
    }
    for (std::size_t d = 0; d < unknowns_.of_dof.size(); ++d) {
        const std::int32_t i = unknowns_.of_dof[d];
        x[static_cast<Eigen::Index>(d)] = i >= 0 ? solution_[i] : 0.0;
    }
}

}  // namespace breach::fem
