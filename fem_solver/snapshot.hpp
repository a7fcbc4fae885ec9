// The motion as a snapshot file.
#pragma once

#include "core/exchange/mesh_snapshot.hpp"
#include "fem_solver/solve/beginning.hpp"

namespace breach::fem {

/// The body alone: free-field columns stay behind.
exchange::MeshSnapshot snapshot_of(const scene::Scene& scene, const Model& model,
                                   const Motion& motion, const Beginning& beginning, double time,
                                   std::int64_t step);

/// "snapshot_0.250000.vtkhdf"
std::string snapshot_name(double time);

}  // namespace breach::fem
