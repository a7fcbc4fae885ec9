// The names in a folder, on the disk.
#pragma once

#include <filesystem>

namespace breach::orchestrator {

/// A machine that goes down must not find a file noted and its name gone.
void sync_folder(const std::filesystem::path& folder);

}  // namespace breach::orchestrator
