// One run as a folder that explains itself: results, study, tasks with logs and every artifact,
// RO-Crate metadata.
#pragma once

#include <filesystem>
#include <string>

#include "services/cli/commands.hpp"

namespace breach::cli {

/// Downloads into `folder`:
///     ro-crate-metadata.json  run.json  study.json  results.json  results.csv
///     tasks/<label>/task.json  tasks/<label>/log.<attempt>.txt  tasks/<label>/<artifact>
/// Each artifact appears under its name only when its SHA-256 is what the server promised.
/// Artifacts that are there already and whole are kept, so that an export that broke off can be
/// repeated. Throws IoError when the folder holds something else or a file is not what it should
/// be.
fault::ExitCode export_run(Server& server, const std::string& run,
                           const std::filesystem::path& folder, const Console& console);

/// A name from the server as a path below the folder; throws IoError for a name that leads out of
/// it.
std::filesystem::path path_below(const std::filesystem::path& folder, const std::string& name);

}  // namespace breach::cli
