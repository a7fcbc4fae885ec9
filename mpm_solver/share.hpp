// Loops over all points, distributed among the threads by strips.
// Called by each operation of step.cpp. Threads do not change results: which strips run together
// and the order of all sums are fixed.
#pragma once

#include "mpm_solver/body/body.hpp"

namespace breach::mpm {

/// Memory that a loop writes besides its own points.
enum class Writes {
    own_points,  ///< none: all strips at once
    nodes,       ///< nodes or cells: only strips that share none at once
};

/// Runs one of the loops of every zone over every strip; sums in the order of the strips, equal for
/// any number of threads.
Totals for_all_points(Body& body, Loop Loops::*loop, Writes writes, double dt);

/// Anti-locking: resets the used cells.
void forget_averages(Body& body);

}  // namespace breach::mpm
