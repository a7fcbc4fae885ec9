#include "transfer_tool/dense_system.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

namespace breach::transfer {
namespace {

Eigen::MatrixXd matrix(int N) {
    Eigen::MatrixXd A(N, N);
    for (int i = 0; i < N; ++i)
        for (int j = 0; j < N; ++j) A(i, j) = std::sin(1.3 * i * j + 0.7 * i) + (i == N - 1 - j);
    return A;
}

// 250 unknowns: two whole blocks and a part of a third; pivoting is needed everywhere.
TEST(DenseSystem, SolvesAsALibraryDoesWithAnyNumberOfThreads) {
    const Eigen::MatrixXd A = matrix(250);
    const Eigen::MatrixXd B = A.leftCols(3) * 2.0 + A.rightCols(3);
    const Eigen::MatrixXd expected = A.partialPivLu().solve(B);
    Eigen::MatrixXd first;
    for (const int threads : {1, 2, 3}) {
        Eigen::MatrixXd system = A;
        Eigen::MatrixXd X = B;
        ASSERT_EQ(solve_in_place(system, X, threads, {}), Solved::done);
        EXPECT_LT((X - expected).norm() / expected.norm(), 1e-9);
        if (threads == 1) first = X;
        EXPECT_EQ(X, first) << threads << " threads";
    }
}

TEST(DenseSystem, ReportsItsProgressAndStopsOnRequest) {
    std::vector<double> shares;
    Eigen::MatrixXd A = matrix(400);
    Eigen::MatrixXd B = A.leftCols(1);
    const Watch watch{[&](double share) {
        shares.push_back(share);
        return shares.size() < 3;
    }};
    EXPECT_EQ(solve_in_place(A, B, 1, watch), Solved::stopped);
    ASSERT_EQ(shares.size(), 3u);
    EXPECT_EQ(shares[0], 0.0);
    EXPECT_LT(shares[1], shares[2]);
}

}  // namespace
}  // namespace breach::transfer
