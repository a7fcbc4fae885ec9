#include "fem_solver/solve/linear_system.hpp"

#include <algorithm>

namespace breach::fem {
namespace {

std::array<std::int32_t, 8> displacements_of(const Quad& quad, const Unknowns& unknowns) {
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

/// Calls visit(row, column) for the 64 entries of each element, column by column; -1 if fixed.
template <typename Visit>
void LinearSystem::visit_elements(Visit visit) const {
    for (const Quad& quad : model_.mesh.quads) {
        const auto n = displacements_of(quad, unknowns_);
        // Column by column, as Eigen stores an element's matrix: place_ and its values run in step.
        // Pattern, places and assembly must keep this order.
        for (const std::int32_t j : n) {
            for (const std::int32_t i : n) visit(i, j);
        }
    }
}

/// Calls visit(row, column) for each saturated element: 32 entries of Q (pressure row, displacement
/// column), then 16 of B_p.
template <typename Visit>
void LinearSystem::visit_water(Visit visit) const {
    if (unknowns_.of_pressure.empty()) return;
    for (const PorousElement& each : model_.water.elements) {
        const Quad& quad = model_.mesh.quads[each.element];
        const auto n = displacements_of(quad, unknowns_);
        for (const std::int32_t j : quad) {
            for (const std::int32_t i : n) visit(unknowns_.of_pressure[j], i);
        }
        for (const std::int32_t j : quad) {
            for (const std::int32_t i : quad) {
                visit(unknowns_.of_pressure[i], unknowns_.of_pressure[j]);
            }
        }
    }
}

LinearSystem::LinearSystem(const Model& model, Unknowns unknowns, Symmetry symmetry)
    : model_(model), symmetry_(symmetry), unknowns_(std::move(unknowns)) {
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(model.mesh.quads.size() * 64 + model.water.elements.size() * 48);
    const auto note = [&](std::int32_t i, std::int32_t j) {
        if (is_stored(i, j, symmetry_)) entries.emplace_back(i, j, 1.0);
    };
    visit_elements(note);
    visit_water(note);
    A_.resize(unknowns_.count, unknowns_.count);
    A_.setFromTriplets(entries.begin(), entries.end());
    A_.makeCompressed();
    const auto place = [&](std::int32_t i, std::int32_t j) {
        return is_stored(i, j, symmetry_) ? index_of(A_, i, j) : -1;
    };
    // Places in the value array are found once; assembling is then addition without a search.
    place_.reserve(model.mesh.quads.size() * 64);
    visit_elements([&](std::int32_t i, std::int32_t j) { place_.push_back(place(i, j)); });
    visit_water([&](std::int32_t i, std::int32_t j) { of_water_.push_back(place(i, j)); });
    for (std::int32_t i = 0; i < unknowns_.count; ++i) diagonal_.push_back(index_of(A_, i, i));
    if (symmetry_ == Symmetry::symmetric) {
        ldlt_.analyzePattern(A_);
    } else {
        lu_.analyzePattern(A_);
    }
    product_in_.resize(unknowns_.count);
    product_out_.resize(unknowns_.count);
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

void LinearSystem::add_water(const TimeRule& rule) {
    if (of_water_.empty()) return;
    // The mass balance is divided by -c_v: only then are the two coupling blocks transposes of each
    // other.
    const double of_storage = 1.0 / (rule.gamma_dt() * rule.c_v), of_conduction = 1.0 / rule.c_v;
    const std::int32_t* place = of_water_.data();
    double* values = A_.valuePtr();
    for (const PorousElement& each : model_.water.elements) {
        const Eigen::Matrix4d B = of_storage * each.S + of_conduction * each.H;
        for (int entry = 0; entry < 32; ++entry, ++place) {
            if (*place >= 0) values[*place] -= each.Q.data()[entry];
        }
        for (int entry = 0; entry < 16; ++entry, ++place) {
            if (*place >= 0) values[*place] -= B.data()[entry];
        }
    }
}

Factorisation LinearSystem::factorise() {
    if (symmetry_ == Symmetry::general) {
        lu_.factorize(A_);
        return lu_.info() == Eigen::Success ? Factorisation::done : Factorisation::failed;
    }
    ldlt_.factorize(A_);
    if (ldlt_.info() != Eigen::Success) return Factorisation::failed;
    // A tangent that softens can have negative pivots where the factorisation itself succeeds.
    const auto positive = (ldlt_.vectorD().array() > 0.0).count();
    const auto negative = (ldlt_.vectorD().array() < 0.0).count();
    const bool right_signs =
        positive == unknowns_.displacements && negative == unknowns_.pressures();
    return right_signs ? Factorisation::done : Factorisation::wrong_sign;
}

void LinearSystem::add_product(double factor, const Eigen::VectorXd& x, Eigen::VectorXd& y) {
    for (std::size_t d = 0; d < unknowns_.of_dof.size(); ++d) {
        const std::int32_t i = unknowns_.of_dof[d];
        if (i >= 0) product_in_[i] = x[static_cast<Eigen::Index>(d)];
    }
    product_out_.noalias() = A_.selfadjointView<Eigen::Lower>() * product_in_;
    // Adds a tied dof's share to the first dof of its tie: only sums matter.
    for (std::size_t d = 0; d < unknowns_.of_dof.size(); ++d) {
        const std::int32_t i = unknowns_.of_dof[d];
        if (i < 0) continue;
        y[static_cast<Eigen::Index>(d)] += factor * product_out_[i];
        product_out_[i] = 0.0;
    }
}

void LinearSystem::solve(const Eigen::VectorXd& r, Eigen::VectorXd& x) {
    if (symmetry_ == Symmetry::symmetric) {
        x = ldlt_.solve(r);
    } else {
        x = lu_.solve(r);
    }
}

void LinearSystem::copy_diagonal(Eigen::VectorXd& diagonal) const {
    for (std::int32_t i = 0; i < unknowns_.count; ++i) {
        diagonal[i] = std::abs(A_.valuePtr()[diagonal_[i]]);
    }
}

}  // namespace breach::fem
