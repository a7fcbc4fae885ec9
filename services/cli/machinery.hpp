// What the server is doing and how its files came to be: workers, transfers, provenance.
#pragma once

#include <string>

#include "services/cli/commands.hpp"

namespace breach::cli {

/// What runs where, and the queue.
fault::ExitCode workers(Server& server, const Console& console);

struct TransfersOptions {
    std::string run;  ///< empty: of all runs
    std::string why;  ///< only those made for this reason; empty: all
    std::size_t most = 50;
};
/// Why each transfer was made, how long it waited, what came of it; newest first.
fault::ExitCode transfers(Server& server, const TransfersOptions& options, const Console& console);

/// From a file up to scene and study, one line per step; as JSON: PROV-JSON.
fault::ExitCode provenance(Server& server, const std::string& sha256, const Console& console);

}  // namespace breach::cli
