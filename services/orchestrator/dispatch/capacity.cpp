// What one round may still start. Attempts builds it anew from the live attempts in every round,
// and ReadyTasks takes from its copy; nothing is ever given back, so that no leak can shrink the
// machine.
#include "services/orchestrator/dispatch/capacity.hpp"

#include <algorithm>

namespace breach::orchestrator {

void Capacity::take(const Task& task) {
    cores_ -= task.resources.cores;
    memory_mb_ -= task.resources.memory_mb;
    ++running_[task.phase];
}

bool Capacity::is_full(const std::string& phase) const {
    const auto limit = settings_.limits.find(phase);
    if (limit == settings_.limits.end()) return false;
    const auto running = running_.find(phase);
    return (running == running_.end() ? 0 : running->second) >= limit->second;
}

std::vector<std::string> Capacity::full_phases() const {
    std::vector<std::string> full;
    for (const auto& [phase, limit] : settings_.limits)
        if (is_full(phase)) full.push_back(phase);
    return full;
}

bool Capacity::has_room_for(const Task& task) const {
    const bool fits = task.resources.cores <= cores_ &&
                      (settings_.memory_mb == 0 || task.resources.memory_mb <= memory_mb_);
    // Otherwise a task larger than the machine would never start; it runs alone and slowly
    // instead.
    return fits || running_.empty();
}

std::size_t Capacity::free_cores() const {
    return static_cast<std::size_t>(std::max<std::int64_t>(cores_, 0));
}

}  // namespace breach::orchestrator
