// Decisions of an analysis beside its model: how soil begins its laws, when steps are cut, what is
// written when. Each is made once: the analysis reads the values, the plan prints the lines.
#pragma once

#include "fem_solver/mesh/mesh.hpp"
#include "fem_solver/model/choose.hpp"

namespace breach::fem {

/// Initial stresses for laws with a memory.
enum class MemoryStart { as_they_are, at_rest_with_friction };

struct RunDecisions {
    /// The stage in which such laws begin, the first with the scene's laws; nothing: there is none.
    process::Decided<std::optional<std::int64_t>> memory;
    process::Decided<MemoryStart> memory_start;
    /// Whether the columns run alone before the mesh moves: snapshots then carry their base's motion.
    process::Decided<bool> free_ground;
    process::Decided<std::vector<double>> snapshot_times;  ///< [s]
    process::Decided<double> snapshot_interval;            ///< 0: none [s]
    process::Decided<std::optional<scene::LiquefactionWatch>> liquefaction;
    process::Decided<double> largest_step_error;  ///< 0: steps follow the iterations alone [m]
};

RunDecisions decide_run(const scene::Scene& scene);

/// All decisions of the FEM about a scene.
struct Decisions {
    process::Decided<Mesher> mesher;
    ModelDecisions model;
    RunDecisions run;
};
Decisions decide(const scene::Scene& scene);

/// The lines of the decisions, and those of the soils' laws.
process::Plan plan_of(const Decisions& decisions, const scene::Scene& scene);

}  // namespace breach::fem
