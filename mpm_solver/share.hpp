// A loop over all points, divided by strips among the threads.
#pragma once

#include "mpm_solver/body/body.hpp"

namespace breach::mpm {

/// Memory that a loop writes besides its own points.
enum class Writes {
    own_points,  ///< nothing: all strips at once
    nodes,       ///< nodes or cells: strips that share none at once
};

/// Runs one of the loops of every zone over every strip; returns its sums, strip by strip in their
/// order: the same for any number of threads.
Totals for_all_points(Body& body, Loop Loops::*loop, Writes writes, double dt);

/// Anti-locking: resets the cells in use.
void forget_averages(Body& body);

}  // namespace breach::mpm
