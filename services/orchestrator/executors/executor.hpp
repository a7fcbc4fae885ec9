// Where attempts run: this machine (local), later a cluster. The dispatcher knows no more of it
// than this.
#pragma once

#include "services/orchestrator/executors/order.hpp"

namespace breach::orchestrator {

enum class Life {
    alive,  ///< some process of the attempt still runs
    ended,  ///< the exit record is there
    gone,   ///< no process, no record
};

class Executor {
  public:
    virtual ~Executor() = default;
    /// Starts the order. The attempt's row is stored already. Throws IoError when it cannot be
    /// started.
    virtual void submit(const AttemptFolder& folder, const Order& order) = 0;
    /// What is true now; right after a restart too.
    virtual Life probe(const AttemptFolder& folder) = 0;
    /// Asks the whole process tree to end; returns at once.
    virtual void stop(const AttemptFolder& folder, StopReason reason) = 0;
    /// Makes sure that nothing of a vanished attempt runs on.
    virtual void clear_away(const std::string& attempt) = 0;
};

}  // namespace breach::orchestrator
