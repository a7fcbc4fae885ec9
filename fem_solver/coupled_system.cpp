#include "fem_solver/coupled_system.hpp"

#include <algorithm>
#include <cmath>

namespace breach::fem {

/// Calls add(row, column, value) for every lower entry of the water's blocks, element by element.
template <typename Add>
void CoupledSystem::visit_water(const TimeRule& rule, double gamma_dt, Add add) const {
    const double c_v = rule.c_v;
    for (const PorousElement& each : water_.elements) {
        const Quad& quad = model_.mesh.quads[each.element];
        const Eigen::Matrix4d B = (each.S / gamma_dt + each.H) / c_v;
        for (int j = 0; j < 4; ++j) {
            const std::int32_t p_j = water_.unknown_of_node[quad[j]];
            if (p_j < 0) continue;
            for (int i = 0; i < 8; ++i) {
                const std::size_t dof = 2 * static_cast<std::size_t>(quad[i / 2]) + (i % 2);
                const std::int32_t u_i = model_.unknowns.of_dof[dof];
                if (u_i >= 0) add(n_u_ + p_j, u_i, -each.Q[i]);
            }
            for (int i = 0; i < 4; ++i) {
                const std::int32_t p_i = water_.unknown_of_node[quad[i]];
                if (p_i >= p_j) add(n_u_ + p_i, n_u_ + p_j, -B(i, j));
            }
        }
    }
}

CoupledSystem::CoupledSystem(const Model& model, const PoreWater& water, const LinearSystem& solid)
    : model_(model), water_(water), n_u_(model.unknowns.count) {
    std::vector<Eigen::Triplet<double>> entries;
    const Sparse& A_u = solid.matrix();
    for (int j = 0; j < A_u.outerSize(); ++j) {
        for (Sparse::InnerIterator it(A_u, j); it; ++it) entries.emplace_back(it.row(), j, 1.0);
    }
    const TimeRule any{1.0, 1.0};
    visit_water(any, 1.0,
                [&](int row, int column, double) { entries.emplace_back(row, column, 1.0); });
    const std::int32_t size = n_u_ + water.unknowns;
    A_.resize(size, size);
    A_.setFromTriplets(entries.begin(), entries.end());
    A_.makeCompressed();
    const auto place = [&](int row, int column) {
        const int* begin = A_.innerIndexPtr() + A_.outerIndexPtr()[column];
        const int* end = A_.innerIndexPtr() + A_.outerIndexPtr()[column + 1];
        return static_cast<std::int32_t>(std::lower_bound(begin, end, row) - A_.innerIndexPtr());
    };
    for (int j = 0; j < A_u.outerSize(); ++j) {
        for (Sparse::InnerIterator it(A_u, j); it; ++it) {
            place_of_solid_.push_back(place(static_cast<int>(it.row()), j));
        }
    }
    visit_water(any, 1.0, [&](int row, int column, double) {
        place_of_water_.push_back(place(row, column));
    });
    ldlt_.analyzePattern(A_);
    right_ = solution_ = scale_ = Eigen::VectorXd::Zero(size);
}

Factorisation CoupledSystem::factorise(const LinearSystem& solid, const TimeRule& rule,
                                       double gamma_dt) {
    c_v_ = rule.c_v;
    double* values = A_.valuePtr();
    std::fill(values, values + A_.nonZeros(), 0.0);
    const auto of_solid = solid.values();
    for (std::size_t k = 0; k < of_solid.size(); ++k) values[place_of_solid_[k]] += of_solid[k];
    std::size_t next = 0;
    visit_water(rule, gamma_dt,
                [&](int, int, double value) { values[place_of_water_[next++]] += value; });
    // Stiffness and storage differ by some twelve orders of magnitude: Jacobi scaling D A D.
    for (int j = 0; j < A_.outerSize(); ++j) {
        const double diagonal = std::abs(values[A_.outerIndexPtr()[j]]);
        if (!(diagonal > 0.0)) return Factorisation::failed;
        scale_[j] = 1.0 / std::sqrt(diagonal);
    }
    for (int j = 0; j < A_.outerSize(); ++j) {
        for (Sparse::InnerIterator it(A_, j); it; ++it) {
            it.valueRef() *= scale_[it.row()] * scale_[j];
        }
    }
    ldlt_.factorize(A_);
    if (ldlt_.info() != Eigen::Success) return Factorisation::failed;
    const auto positive = (ldlt_.vectorD().array() > 0.0).count();
    const auto negative = (ldlt_.vectorD().array() < 0.0).count();
    return positive == n_u_ && negative == water_.unknowns ? Factorisation::done
                                                           : Factorisation::not_positive;
}

void CoupledSystem::solve(const Eigen::VectorXd& R_u, const Eigen::VectorXd& R_p,
                          Eigen::VectorXd& d_u, Eigen::VectorXd& d_p) {
    for (std::size_t d = 0; d < model_.unknowns.of_dof.size(); ++d) {
        const std::int32_t i = model_.unknowns.of_dof[d];
        if (i >= 0) right_[i] = R_u[static_cast<Eigen::Index>(d)];
    }
    for (std::size_t n = 0; n < water_.unknown_of_node.size(); ++n) {
        const std::int32_t i = water_.unknown_of_node[n];
        if (i >= 0) right_[n_u_ + i] = -R_p[static_cast<Eigen::Index>(n)] / c_v_;
    }
    right_.array() *= scale_.array();
    solution_ = ldlt_.solve(right_);
    solution_.array() *= scale_.array();
    for (std::size_t d = 0; d < model_.unknowns.of_dof.size(); ++d) {
        const std::int32_t i = model_.unknowns.of_dof[d];
        d_u[static_cast<Eigen::Index>(d)] = i >= 0 ? solution_[i] : 0.0;
    }
    for (std::size_t n = 0; n < water_.unknown_of_node.size(); ++n) {
        const std::int32_t i = water_.unknown_of_node[n];
        d_p[static_cast<Eigen::Index>(n)] = i >= 0 ? solution_[n_u_ + i] : 0.0;
    }
}

}  // namespace breach::fem
