// What attempts may occupy together, and what is left of it.
#pragma once

#include "services/orchestrator/dispatch/settings.hpp"

namespace breach::orchestrator {

class Capacity {
  public:
    /// Of these settings, which outlive it; nothing runs.
    explicit Capacity(const DispatchSettings& settings)
        : settings_(settings),
          cores_(static_cast<std::int64_t>(settings.slots)),
          memory_mb_(settings.memory_mb) {}

    void take(const Task& task);
    /// As many of the phase run as may.
    bool is_full(const std::string& phase) const;
    std::vector<std::string> full_phases() const;
    /// One that asks for more than there is runs alone.
    bool has_room_for(const Task& task) const;
    std::size_t free_cores() const;

  private:
    const DispatchSettings& settings_;
    std::int64_t cores_;  ///< below 0: one that asks for more runs alone
    std::int64_t memory_mb_;
    std::map<std::string, std::size_t> running_;  ///< by phase
};

}  // namespace breach::orchestrator
