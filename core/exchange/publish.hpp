// A file that exists under its final name is whole: written beside it, fsynced, renamed, folder
// fsynced.
#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

namespace breach::exchange {

/// Calls write(temporary path), then publishes the result as `path`. On any exception the temporary
/// is removed and nothing appears under the final name. Throws IoError (disk full, no permission),
/// naming path and cause.
void publish(const std::filesystem::path& path,
             const std::function<void(const std::filesystem::path&)>& write);

void publish_text(const std::filesystem::path& path, std::string_view text);

}  // namespace breach::exchange
