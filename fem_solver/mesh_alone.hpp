// `fem_solver mesh`: the mesh and nothing else, to be looked at before anything runs.
#pragma once

#include "core/process/phase.hpp"

namespace breach::fem {

/// Writes snapshot_0.000000.vtkhdf, of a body without stress, and the mesh's quality.
process::Phase mesh_phase();

}  // namespace breach::fem
