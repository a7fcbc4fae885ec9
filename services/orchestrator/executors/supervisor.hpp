// The supervisor: a small process (`breachline supervise`) between the service and one attempt of a
// phase. It holds the attempt's lock, runs the phase, stops the whole process tree when asked, and
// writes the exit record, so that nothing is lost when the service dies meanwhile.
#pragma once

#include <filesystem>

namespace breach::orchestrator {

/// Origin of the attempt's lock: inherited from the service as a descriptor, or taken by the
/// supervisor (on a cluster's node, where a repeated job must find the attempt locked).
enum class AttemptLock { inherited, to_be_taken };

/// Runs the attempt in `folder`. Returns the supervisor's own exit code, not the phase's. Does
/// nothing when the attempt runs already, has ended, or was given up.
int supervise(const std::filesystem::path& folder, AttemptLock lock);

/// After a supervisor was killed: kills the remaining processes of its phase on this machine.
void end_strays(const std::filesystem::path& folder);

}  // namespace breach::orchestrator
