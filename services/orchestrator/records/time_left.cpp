// An estimate for people, computed at each request: nothing depends on it. Work that is left over
// the workers that run now; how many will run later is not known.
#include "services/orchestrator/records/time_left.hpp"

#include <algorithm>

namespace breach::orchestrator {

std::optional<double> time_left(const std::vector<PhaseLeft>& phases, double fractions) {
    if (phases.empty()) return std::nullopt;  // a trigger may still add tasks
    double work = 0.0, waiting = 0.0, running = 0.0, running_for = 0.0;
    bool known = true;
    for (const PhaseLeft& each : phases) {
        const auto going = static_cast<double>(each.running);
        waiting += static_cast<double>(each.waiting);
        running += going;
        running_for += each.running_for;
        if (each.pace)
            work += static_cast<double>(each.waiting) * *each.pace +
                    std::max(0.0, going * *each.pace - each.running_for);
        else
            known = false;
    }
    if (known) return work / std::max(1.0, running);
    constexpr double too_early = 0.02;
    if (waiting > 0.0 || running == 0.0 || fractions / running < too_early) return std::nullopt;
    // No phase has finished a task: use the reported progress.
    // The running tasks together, as if they were one.
    const double done = fractions / running;
    return running_for / running * (1.0 - done) / done;
}

}  // namespace breach::orchestrator
