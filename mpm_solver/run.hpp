// The phase: from a session's scene and input to its outputs.
#pragma once

#include "core/process/phase.hpp"

namespace breach::mpm {

/// Raise it when the numbers change for the same input: the cache then reuses no older result.
inline constexpr int numerics = 14;

/// The features of this phase that the scene uses and leaves out.
process::Plan plan(const scene::Scene& scene);

process::Outcome run(process::Session& session);

/// Ten steps of the body from the start of the run, timed step by step.
process::Cost measure(process::Session& session);

}  // namespace breach::mpm
