// `fem_solver mesh`: only meshes, to check the mesh before a run.
// services/drawing asks for it to show elements before a run (mesh_question.cpp).
#pragma once

#include "core/process/phase.hpp"

namespace breach::fem {

/// Writes snapshot_0.000000.vtkhdf, without stress, and the mesh's quality.
process::Phase mesh_phase();

}  // namespace breach::fem
