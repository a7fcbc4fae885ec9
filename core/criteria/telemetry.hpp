// Telemetry of a phase as criteria see it: one JSON object per line, numbers by name, time
// ascending.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/criteria/criterion.hpp"

namespace breach::criteria {

struct TelemetryLine {
    double time;                           ///< simulated [s]
    std::int64_t step;                     ///< 0 where the line has none
    std::map<std::string, double> values;  ///< every entry that is a number, "time" among them
};

/// All lines that are whole: a file that is still being written may end inside one. Lines that are
/// not later than the one before (a phase that was resumed) are left out. Throws IoError when the
/// file cannot be read, BadInput when no line holds a time or one with another behind it is no JSON.
std::vector<TelemetryLine> read_telemetry(const std::filesystem::path& file);

/// The line as this expression wants it; NaN where the line lacks a field.
Line line_for(const Expression& expression, const TelemetryLine& telemetry);

}  // namespace breach::criteria
