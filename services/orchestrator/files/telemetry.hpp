// Telemetry of a phase: JSON lines that may still grow, read from a given line on.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace breach::orchestrator {

struct TelemetryRequest {
    std::vector<std::string> fields;  ///< empty: all
    std::int64_t from = 0;            ///< first line, from 0
    std::int64_t stride = 1;          ///< every stride-th line, counted from line 0
};

/// {"lines":[...],"next":LINE}: `next` is where to continue; an incomplete last line is left for
/// later.
nlohmann::json read_telemetry(const std::filesystem::path& file, const TelemetryRequest& request);

}  // namespace breach::orchestrator
