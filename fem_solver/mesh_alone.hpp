// `fem_solver mesh`: the mesh alone, for inspection before a run.
#pragma once

#include "core/process/phase.hpp"

namespace breach::fem {

/// Writes snapshot_0.000000.vtkhdf, of a body without stress, and the mesh's quality.
process::Phase mesh_phase();

}  // namespace breach::fem
