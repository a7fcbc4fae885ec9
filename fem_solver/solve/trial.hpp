// Marks a run as a trial (--plan --measure).
// trial.cpp sets it; a trial leaves out what only results need, such as the motion of the free
// ground.
#pragma once

namespace breach::fem {

/// Switch of the session: the run measures CPU seconds.
inline constexpr const char* trial_switch = "--measure";

}  // namespace breach::fem
