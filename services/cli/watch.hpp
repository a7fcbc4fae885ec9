// Watches a run: updates a few lines in place on a terminal, else prints one line per change, or
// the events with --json.
#pragma once

#include <string>

#include "services/cli/commands.hpp"

namespace breach::cli {

/// Returns code_of_end when the run has ended. Waits up to a minute for a server that does not
/// answer, then throws Unreachable.
fault::ExitCode watch(Server& server, const std::string& run, Questionable questionable,
                      const Console& console);

}  // namespace breach::cli
