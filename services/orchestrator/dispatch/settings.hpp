// How attempts are given out and tried again.
#pragma once

#include <chrono>
#include <filesystem>
#include <map>

#include "services/orchestrator/records/records.hpp"

namespace breach::orchestrator {

struct DispatchSettings {
    std::filesystem::path bin;   ///< folder of the phase executables
    std::size_t slots = 1;       ///< cores that attempts may occupy together
    std::int64_t memory_mb = 0;  ///< that attempts may ask for together; 0: not limited
    std::map<std::string, std::size_t> limits;  ///< attempts at the same time, by phase
    double grace_seconds = 5;                   ///< between TERM and KILL
    std::int64_t most_tries = 4;
    std::chrono::milliseconds retry_delay{500};  ///< doubled with each further try
    Numerics numerics = {};                      ///< of the programs in `bin`, as they say it
};

}  // namespace breach::orchestrator
