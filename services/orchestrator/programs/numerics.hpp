// Queries the phases for the versions of their numerics, which the cache needs.
#pragma once

#include <filesystem>

#include "services/orchestrator/records/records.hpp"

namespace breach::orchestrator {

/// For every phase in the folder: the line "numerics N" of its --version. Throws IoError, naming
/// the program, when one is missing or prints no such line.
Numerics numerics_of_phases(const std::filesystem::path& bin);

}  // namespace breach::orchestrator
