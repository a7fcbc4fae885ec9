// Opens the output files of phases.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

namespace breach::report {

/// Throws IoError if the file cannot be read, BadInput if it is not JSON.
nlohmann::json read_json(const std::filesystem::path& path);

}  // namespace breach::report
