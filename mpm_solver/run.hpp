// The phase: from a session's scene and input to its outputs.
#pragma once

#include "core/process/phase.hpp"

namespace breach::mpm {

/// Raised when the numbers change for the same input: the cache takes no result of another one.
inline constexpr int numerics = 14;

/// What the scene needs of this phase and what it does not.
process::Plan plan(const scene::Scene& scene);

process::Outcome run(process::Session& session);

/// Ten steps of the body as the run would begin with it, verb by verb.
process::Cost measure(process::Session& session);

}  // namespace breach::mpm
