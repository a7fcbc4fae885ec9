// The motion as a snapshot file.
#pragma once

#include "core/exchange/mesh_snapshot.hpp"
#include "core/phases/files.hpp"
#include "fem_solver/solve/beginning.hpp"

namespace breach::fem {

/// The body alone: free-field columns stay behind.
exchange::MeshSnapshot snapshot_of(const scene::Scene& scene, const Model& model,
                                   const Motion& motion, const Beginning& beginning, double time,
                                   std::int64_t step);

/// "snapshot_0.250000.vtkhdf"
using phases::files::snapshot_name;

}  // namespace breach::fem
