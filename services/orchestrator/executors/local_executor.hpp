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
    Life probe(const AttemptFolder& folder) override;
    void stop(const AttemptFolder& folder, StopReason reason) override;
    void clear_away(const std::string& attempt) override;

  private:
    struct Supervisor {
        pid_t pid;
        AttemptFolder folder;
        std::string attempt;
    };
    void reap();

    std::filesystem::path self_;
    std::vector<Supervisor>
        supervisors_;  ///< our children, to be reaped; liveness never hangs on the pids
};

}  // namespace breach::orchestrator
