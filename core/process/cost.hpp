// Cost of a time step, measured in a short trial: output of --plan --measure.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace breach::process {

struct Cost {
    std::vector<std::pair<std::string, std::int64_t>> counts;  ///< "unknown pressures", how many
    std::vector<std::pair<std::string, double>> memory;        ///< "points", bytes
    std::int64_t steps = 0;                                    ///< number of trial steps
    std::vector<std::pair<std::string, double>> seconds;  ///< "law": time in all trial steps [s]
};

/// Aligned text: counts, bytes, seconds per step and shares.
std::string as_text(const Cost& cost);

}  // namespace breach::process
