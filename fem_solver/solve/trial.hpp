// Marks a run as a trial (--plan --measure).
#pragma once

namespace breach::fem {

/// Switch of the session: the run measures CPU seconds.
inline constexpr const char* trial_switch = "--measure";

}  // namespace breach::fem
