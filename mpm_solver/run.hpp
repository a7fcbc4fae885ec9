// The phase: from a session's scene and input to its outputs.
// main.cpp hands these functions to core/process, which parses arguments, loads the scene and turns
// exceptions into exit codes.
#pragma once

#include "core/process/phase.hpp"

namespace breach::mpm {

/// Raise it when results change for the same input: the cache then reuses no older result.
inline constexpr int numerics = 15;

/// Features of this phase: used by the scene or not.
process::Plan plan(const scene::Scene& scene);

process::Outcome run(process::Session& session);

/// Runs ten steps from the start, timed step by step.
process::Cost measure(process::Session& session);

}  // namespace breach::mpm
