// Decisions of an analysis apart from its model: the start of laws, error control of steps, output.
// The analysis uses the values, the plan prints the lines.
#pragma once

#include "fem_solver/mesh/mesh.hpp"
#include "fem_solver/model/choose.hpp"

namespace breach::fem {

/// Initial stresses for laws with a memory.
enum class MemoryStart { as_they_are, at_rest_with_friction };

struct RunDecisions {
    /// The first stage with the scene's laws, in which laws with memory start; none: no such law.
    process::Decided<std::optional<std::int64_t>> memory;
    process::Decided<MemoryStart> memory_start;
    /// Whether the columns run alone before the dynamic stages: snapshots then contain their base
    /// motion.
    process::Decided<bool> free_ground;
    process::Decided<std::vector<double>> snapshot_times;  ///< [s]
    process::Decided<double> snapshot_interval;            ///< 0: none [s]
    process::Decided<std::optional<scene::LiquefactionWatch>> liquefaction;
    process::Decided<double> largest_step_error;  ///< 0: the iterations alone control the step [m]
};

RunDecisions decide_run(const scene::Scene& scene);

struct Decisions {
    process::Decided<Mesher> mesher;
    ModelDecisions model;
    RunDecisions run;
};
Decisions decide(const scene::Scene& scene);

/// Lines of the decisions and of the laws.
process::Plan plan_of(const Decisions& decisions, const scene::Scene& scene);

}  // namespace breach::fem
