// Remaining time of an open run, from its recent pace, phase by phase.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace breach::orchestrator {

/// The tasks of one phase of a run that have not ended.
struct PhaseLeft {
    std::int64_t waiting = 0;
    std::int64_t running = 0;
    double running_for = 0.0;    ///< sum over its running tasks [s]
    std::optional<double> pace;  ///< time of one of the last computed tasks [s]
};

/// With as many workers as the run has now [s]. Nothing if it would be a guess: a phase with
/// waiting tasks has not computed any yet. `fractions`: sum of the running tasks' progress.
std::optional<double> time_left(const std::vector<PhaseLeft>& phases, double fractions);

}  // namespace breach::orchestrator
