// SIGINT and SIGTERM as a flag that the computation polls.
#pragma once

#include "core/fault/fault.hpp"

namespace breach::process {

/// From now on SIGINT and SIGTERM set a flag; SIGPIPE is ignored (a closed pipe appears as a write
/// error).
void watch_signals();
bool stop_was_requested();
/// 130 after SIGINT, 143 after SIGTERM.
fault::ExitCode code_of_stop();

}  // namespace breach::process
