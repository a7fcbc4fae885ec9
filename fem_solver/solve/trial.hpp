// What tells a run that it is a trial (--plan --measure).
#pragma once

namespace breach::fem {

/// Among the session's switches: the seconds of the run are those of the CPU.
inline constexpr const char* trial_switch = "--measure";

}  // namespace breach::fem
