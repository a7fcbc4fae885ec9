// Attempts as child processes on this machine, each below its own supervisor in its own session.
#pragma once

#include <sys/types.h>

#include <vector>

#include "services/orchestrator/executors/executor.hpp"

namespace breach::orchestrator {

class LocalExecutor final : public Executor {
  public:
    /// `self`: the breachline executable, started again as `supervise`.
    explicit LocalExecutor(std::filesystem::path self);

    void submit(const AttemptFolder& folder, const Order& order) override;
    Vitals probe(const AttemptFolder& folder) override;
    void stop(const AttemptFolder& folder, StopReason reason) override;
    void clear_away(const AttemptFolder& folder, const std::string& attempt) override;
    /// Their checkpoints are saved first; the next service continues them.
    AtStop at_stop() const override { return AtStop::ends_them; }

  private:
    struct Supervisor {
        pid_t pid;
        AttemptFolder folder;
        std::string attempt;
    };
    void reap();

    std::filesystem::path self_;
    /// Child processes to reap; whether an attempt is alive does not depend on their pids
    std::vector<Supervisor> supervisors_;
};

}  // namespace breach::orchestrator
