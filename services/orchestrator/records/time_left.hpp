// How long an open run will still take: at the pace of what it has just done, phase by phase.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace breach::orchestrator {

/// The tasks of one phase of a run that have not ended.
struct PhaseLeft {
    std::int64_t waiting = 0;
    std::int64_t running = 0;
    double running_for = 0.0;    ///< all of them together [s]
    std::optional<double> pace;  ///< of one of the last that were computed [s]
};

/// With as many workers as the run has now [s]. Nothing where it would be a guess: a phase of which
/// tasks wait has computed none yet. `fractions`: how far the running tasks are, summed up.
std::optional<double> time_left(const std::vector<PhaseLeft>& phases, double fractions);

}  // namespace breach::orchestrator
