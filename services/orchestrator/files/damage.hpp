// Whether a file still has its stored size and hash.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace breach::orchestrator {

enum class Look { at_sizes, at_contents };

/// "is missing", "has 3 bytes, not 5", "has other contents than were stored"; nothing: it is whole.
std::optional<std::string> damage_of(const std::filesystem::path& file, std::int64_t bytes,
                                     const std::string& sha256, Look look = Look::at_contents);

}  // namespace breach::orchestrator
