// Result and cost of each variant of an accuracy study, from its tasks and, for a quantity at a
// given time, from the FEM's telemetry.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "services/orchestrator/files/data_folder.hpp"
#include "services/orchestrator/study/accuracy.hpp"

namespace breach::orchestrator {

/// Cost of the runs of a setting, phase by phase and together. A task from the cache counts with
/// its original cost.
struct Cost {
    double cpu_seconds = 0.0;
    double wall_seconds = 0.0;
    std::optional<double> peak_memory_MB;  ///< the most of any phase
    std::map<std::string, double> cpu_seconds_by_phase;
};

struct Measured {
    std::optional<double> value = {};
    Cost cost = {};
    bool questionable = false;
    bool softens = false;     ///< soil of one of its phases loses strength with strain
    bool has_length = false;  ///< and its shear bands have a length of their own
    std::string reason = {};  ///< why there is no value
};

/// By variant. tasks: of the run.
std::map<std::string, Measured> measured_variants(const std::vector<Task>& tasks,
                                                  const Quantity& quantity, const DataFolder& data);

/// Value of a field at a time, interpolated linearly between two lines of telemetry; nothing: the
/// telemetry ends before or lacks the field. lines: objects with "time", ascending.
std::optional<double> value_at(const nlohmann::json& lines, const std::string& field, double time);

}  // namespace breach::orchestrator
