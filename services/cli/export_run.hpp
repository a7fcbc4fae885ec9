// One run as a self-describing folder: results, study, tasks with logs and every artifact, RO-Crate
// metadata.
#pragma once

#include <filesystem>
#include <string>

#include "services/cli/commands.hpp"

namespace breach::cli {

/// Downloads into `folder`:
///     ro-crate-metadata.json  run.json  study.json  results.json  results.csv
///     tasks/<label>/task.json  tasks/<label>/log.<attempt>.txt  tasks/<label>/<artifact>
/// Each artifact appears under its name only when its SHA-256 is the one in the
/// server's list. Complete artifacts that exist are kept, so that an interrupted export
/// can be repeated. Throws IoError when the folder contains other files or a file is
/// damaged.
fault::ExitCode export_run(Server& server, const std::string& run,
                           const std::filesystem::path& folder, const Console& console);

/// A name from the server as a path below the folder; throws IoError for a name that leads
/// outside.
std::filesystem::path path_below(const std::filesystem::path& folder, const std::string& name);

}  // namespace breach::cli
