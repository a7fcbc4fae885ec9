// Watches a run: on a terminal a few lines that stay in place, else one line per change, with
// --json the events.
#pragma once

#include <string>

#include "services/cli/commands.hpp"

namespace breach::cli {

/// Returns code_of_end when the run has ended. Waits for a server that does not answer for less
/// than a minute; then throws Unreachable.
fault::ExitCode watch(Server& server, const std::string& run, Questionable questionable,
                      const Console& console);

}  // namespace breach::cli
