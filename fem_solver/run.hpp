// fem_solver as a phase: its plan and its run.
// main.cpp hands these functions to core/process.
#pragma once

#include "core/process/phase.hpp"

namespace breach::fem {

/// Raise it when results change for the same input: the cache then reuses no older result.
inline constexpr int numerics = 18;

/// Meshes, analyses and writes: snapshots, telemetry, history.h5, checkpoint.h5.
process::Outcome run(process::Session& session);

/// Runs ten steps of the first dynamic stage, after the stages before it.
process::Cost measure(process::Session& session);

process::Plan plan(const scene::Scene& scene);

}  // namespace breach::fem
