// Lists and removes runs and files on the server's disk.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "services/cli/commands.hpp"

namespace breach::cli {

/// For runs; names of files are "file:sha256/...". cancel_first: cancels it and waits.
enum class IfItRuns { refuse, cancel_first };
/// ask: prints what will be removed and the disk space freed, and asks at a terminal.
enum class Confirm { ask, given };
fault::ExitCode remove_all(Server& server, const std::vector<std::string>& names, IfItRuns options,
                           Confirm confirm, const Console& console);
fault::ExitCode disk_use(Server& server, const Console& console);
fault::ExitCode list_files(Server& server, const Console& console);
/// Sends files and prints their references.
fault::ExitCode send_files(Server& server, const std::vector<std::filesystem::path>& files,
                           const Console& console);
/// Prints the dashboard's address of a run.
fault::ExitCode open_page(Server& server, const std::string& run, const Console& console);

/// "12.3 MB"
std::string in_bytes(double bytes);

}  // namespace breach::cli
