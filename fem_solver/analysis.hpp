// All stages of an analysis in their order, and its end.
#pragma once

#include "core/process/phase.hpp"
#include "fem_solver/course.hpp"

namespace breach::fem {

/// Runs all stages, or until the mesh is entangled: this is a regular end, with the last good state
/// in a snapshot, unless the scene asks to continue. Throws Breakdown when the mesh entangles in its
/// very first step or the least step does not converge; the last good state is then in a snapshot and
/// in the checkpoint.
process::Outcome analyse(Course& course);

}  // namespace breach::fem
