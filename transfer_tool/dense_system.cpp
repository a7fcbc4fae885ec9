#include "transfer_tool/dense_system.hpp"

#include "core/numerics/blocks.hpp"

namespace breach::transfer {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr Index block = 96;

/// LU of columns [k, k + b) below row k; swaps whole rows of A and B.
void factorise_panel(MatrixXd& A, MatrixXd& B, Index k, Index b) {
    const Index N = A.rows();
    for (Index j = k; j < k + b; ++j) {
        Index pivot = 0;
        A.col(j).segment(j, N - j).cwiseAbs().maxCoeff(&pivot);
        if (pivot > 0) {
            A.row(j).swap(A.row(j + pivot));
            B.row(j).swap(B.row(j + pivot));
        }
        A.col(j).segment(j + 1, N - j - 1) /= A(j, j);
        for (Index c = j + 1; c < k + b; ++c)
            A.col(c).segment(j + 1, N - j - 1) -= A(j, c) * A.col(j).segment(j + 1, N - j - 1);
    }
}

/// Updates columns [from, to) to the right of the panel: their rows of U, and the rest.
void update_columns(MatrixXd& A, Index k, Index b, Index from, Index to) {
    const Index below = A.rows() - k - b;
    auto U = A.block(k, from, b, to - from);
    A.block(k, k, b, b).triangularView<Eigen::UnitLower>().solveInPlace(U);
    A.block(k + b, from, below, to - from).noalias() -= A.block(k + b, k, below, b) * U;
}

}  // namespace

Solved solve_in_place(MatrixXd& A, MatrixXd& B, int threads, const Watch& watch) {
    const Index N = A.rows();
    for (Index k = 0; k < N; k += block) {
        // The work that is left grows with the cube of the rows that are left.
        const double left = 1.0 - static_cast<double>(k) / static_cast<double>(N);
        if (!watch.go_on(1.0 - left * left * left)) return Solved::stopped;
        const Index b = std::min(block, N - k);
        factorise_panel(A, B, k, b);
        // A column's sums do not depend on the other columns of its part if parts begin at
        // multiples of the block.
        const auto blocks = static_cast<std::size_t>((N - k - b + block - 1) / block);
        numerics::run_parts(blocks, threads, [&](std::size_t begin, std::size_t end, std::size_t) {
            for (std::size_t i = begin; i < end; ++i) {
                const Index from = k + b + static_cast<Index>(i) * block;
                update_columns(A, k, b, from, std::min(from + block, N));
            }
        });
    }
    A.triangularView<Eigen::UnitLower>().solveInPlace(B);
    A.triangularView<Eigen::Upper>().solveInPlace(B);
    return Solved::done;
}

}  // namespace breach::transfer
