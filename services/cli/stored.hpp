// Lists and removes runs and files on the server's disk.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "services/cli/commands.hpp"

namespace breach::cli {

struct Removal {
    std::vector<std::string> names;  ///< runs, or files as "file:sha256/..."
    bool cancel_first = false;       ///< a run that goes on is cancelled; else it is refused
    bool confirmed = false;          ///< else prints what will be freed, and asks at a terminal
};
fault::ExitCode remove_all(Server& server, const Removal& removal, const Console& console);
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
