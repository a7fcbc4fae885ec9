// Solves a large dense system block by block, with progress reports, stop requests and several
// threads.
// For "interpolation": "paper" alone. Eigen's own LU can neither be stopped nor report progress,
// and 16,384 centres take minutes.
#pragma once

#include <Eigen/Core>

#include "transfer_tool/watch.hpp"

namespace breach::transfer {

enum class Solved { done, stopped };

/// Overwrites A by its LU factors (partial pivoting, blocked outer products: Golub & Van Loan) and
/// B by the solution of A X = B. 2/3 N^3 operations; the result does not depend on the number of
/// threads.
Solved solve_in_place(Eigen::MatrixXd& A, Eigen::MatrixXd& B, int threads, const Watch& watch);

}  // namespace breach::transfer
