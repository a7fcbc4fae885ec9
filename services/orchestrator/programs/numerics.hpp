// Asks the phases for the versions of their numerics, which the cache must know.
#pragma once

#include <filesystem>

#include "services/orchestrator/records/records.hpp"

namespace breach::orchestrator {

/// Of every phase in the folder: the line "numerics N" of what it prints for --version. Throws
/// IoError, naming the program, when one is missing or says nothing of the kind.
Numerics numerics_of_phases(const std::filesystem::path& bin);

}  // namespace breach::orchestrator
