// Commands about workers and transfers.
#pragma once

#include <string>

#include "services/cli/commands.hpp"

namespace breach::cli {

/// Running tasks, and the queue.
fault::ExitCode workers(Server& server, const Console& console);

struct TransfersOptions {
    std::string run;  ///< empty: of all runs
    std::string why;  ///< only those with this reason; empty: all
    std::size_t most = 50;
};
/// For each transfer why it was made, how long it waited and its runouts; newest first.
fault::ExitCode transfers(Server& server, const TransfersOptions& options, const Console& console);

}  // namespace breach::cli
