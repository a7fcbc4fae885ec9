// Commands about workers, transfers and the provenance of files.
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

/// From a file up to scene and study, one line per step; as JSON: PROV-JSON.
fault::ExitCode provenance(Server& server, const std::string& sha256, const Console& console);

}  // namespace breach::cli
