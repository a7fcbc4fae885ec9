// The supervisor: a small process (`breachline supervise`) between the service and one attempt of a
// phase. It holds the attempt's lock, runs the phase, stops the whole process tree when asked, and
// writes the exit record, so that nothing is lost when the service dies meanwhile.
#pragma once

#include <filesystem>

namespace breach::orchestrator {

/// Runs the order in `folder`; returns the supervisor's own exit code (0: the exit record is
/// written).
int supervise(const std::filesystem::path& folder);

}  // namespace breach::orchestrator
