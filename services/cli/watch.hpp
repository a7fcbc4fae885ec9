// A run while it runs: on a terminal a few lines that stay in place, else one line per change, with
// --json the events.
#pragma once

#include <string>

#include "services/cli/commands.hpp"

namespace breach::cli {

/// Returns when the run has ended: code_of_end. A server that goes away for less than a minute is
/// waited for; after that Unreachable is thrown.
fault::ExitCode watch(Server& server, const std::string& run, Questionable questionable,
                      const Console& console);

}  // namespace breach::cli
