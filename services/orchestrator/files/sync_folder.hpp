// Flushes the names in a folder to the disk.
#pragma once

#include <filesystem>

namespace breach::orchestrator {

/// Needed so that after a power failure a recorded file still has its name.
void sync_folder(const std::filesystem::path& folder);

}  // namespace breach::orchestrator
