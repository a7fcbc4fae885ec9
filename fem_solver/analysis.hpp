// Runs all stages of an analysis in order.
#pragma once

#include "core/process/phase.hpp"
#include "fem_solver/course.hpp"

namespace breach::fem {

/// Runs all stages, or until the mesh is entangled: a regular end, with the last good state in a
/// snapshot, because a failing dam folds its mesh sooner or later. Stopped: a checkpoint is
/// written, from which --resume continues. Throws Breakdown if the mesh entangles in the first step
/// or the smallest step does not converge; the last good state is then in a snapshot and in the
/// checkpoint.
process::Outcome analyse(Course& course);

}  // namespace breach::fem
