// Write files atomically: written beside the final path, fsynced, renamed, folder fsynced. A file
// under its final name is complete.
#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

namespace breach::exchange {

/// Calls write(temporary path), then renames the result to `path`. Any exception removes the
/// temporary file and leaves `path` unchanged. Throws IoError (disk full, no permission) with path
/// and cause.
void publish(const std::filesystem::path& path,
             const std::function<void(const std::filesystem::path&)>& write);

void publish_text(const std::filesystem::path& path, std::string_view text);

}  // namespace breach::exchange
