// Resources that attempts may use together, how they are assigned, and what is left for more.
#pragma once

#include <chrono>
#include <filesystem>
#include <map>

#include "services/orchestrator/records/records.hpp"

namespace breach::orchestrator {

struct DispatchSettings {
    std::filesystem::path bin;   ///< folder of the phase executables
    std::size_t slots = 1;       ///< cores that attempts may occupy together
    std::int64_t memory_mb = 0;  ///< memory that attempts may request together; 0: no limit
    std::map<std::string, std::size_t> limits;  ///< simultaneous attempts, by phase
    double grace_seconds = 5;                   ///< between TERM and KILL
    std::int64_t most_tries = 4;
    std::chrono::milliseconds retry_delay{500};  ///< doubled with each further try
    Numerics numerics = {};                      ///< of the programs in `bin`, as they report it
};

class Capacity {
  public:
    /// settings: must outlive it. Initially nothing runs.
    explicit Capacity(const DispatchSettings& settings)
        : settings_(settings),
          cores_(static_cast<std::int64_t>(settings.slots)),
          memory_mb_(settings.memory_mb) {}

    void take(const Task& task);
    /// Whether the phase has as many attempts as it may.
    bool is_full(const std::string& phase) const;
    std::vector<std::string> full_phases() const;
    /// A task that needs more than there is runs alone.
    bool has_room_for(const Task& task) const;
    std::size_t free_cores() const;

  private:
    const DispatchSettings& settings_;
    std::int64_t cores_;  ///< below 0: a task that needs more runs alone
    std::int64_t memory_mb_;
    std::map<std::string, std::size_t> running_;  ///< by phase
};

}  // namespace breach::orchestrator
