// Converts a motion to a snapshot file.
// Recorder writes one at each due time; transfer_tool, report and service read them. A snapshot has
// all that a transfer needs, so that no other file of the FEM must be kept.
#pragma once

#include "core/exchange/mesh_snapshot.hpp"
#include "core/phases/files.hpp"
#include "fem_solver/solve/largest.hpp"

namespace breach::fem {

/// Without free-field columns.
exchange::MeshSnapshot snapshot_of(const scene::Scene& scene, const Model& model,
                                   const Motion& motion, const Beginning& beginning,
                                   const Largest& largest, double time, std::int64_t step);

/// "snapshot_0.250000.vtkhdf"
using phases::files::snapshot_name;

}  // namespace breach::fem
