// One run as a self-describing folder: results, study, tasks with logs and every artifact, and the
// files that were sent for its scene.
#pragma once

#include <filesystem>
#include <string>

#include "services/cli/commands.hpp"

namespace breach::cli {

/// Downloads into `folder`:
///     run.json  study.json  results.json  results.csv
///     means.csv  accuracy.json  uncertainty.json  samples.csv  envelopes.json  motions.json
///         (those that the study has)
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
