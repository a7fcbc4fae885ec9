// Interface for running attempts: on this machine (local) or on a cluster (Slurm). The dispatcher
// uses only this interface; tests/slurm/conformance_test.cpp tests every executor.
#pragma once

#include "services/orchestrator/executors/order.hpp"

namespace breach::orchestrator {

enum class Life {
    handed_over,  ///< stored by the executor, but not yet taken by the machine or the cluster
    queued,       ///< taken; waits for its turn
    alive,        ///< some process of the attempt runs
    ended,        ///< the exit record is there
    gone,         ///< no process, no record, and none will come
};

struct Vitals {
    Life life;
    std::string why = {};  ///< why it is gone, or what it waits for
};

/// Effect of a stop of the service on running attempts.
enum class AtStop { ends_them, leaves_them };

/// An attempt in a cluster's queue.
struct QueuedJob {
    std::filesystem::path folder;  ///< the attempt's
    std::string number;            ///< the cluster's; empty: not known
    std::string state;             ///< the cluster's word
    std::string reason;            ///< why it waits, the cluster's word; empty: it does not wait
};

class Executor {
  public:
    virtual ~Executor() = default;
    /// Takes the order and returns at once; the attempt's row is stored already. Throws IoError
    /// when the attempt cannot be started.
    virtual void submit(const AttemptFolder& folder, const Order& order) = 0;
    /// The present state, also right after a restart. A scheduler's silence is never "gone".
    virtual Vitals probe(const AttemptFolder& folder) = 0;
    /// Asks the whole process tree to end; returns at once.
    virtual void stop(const AttemptFolder& folder, StopReason reason) = 0;
    /// Ensures that no process of an abandoned attempt continues or starts.
    virtual void clear_away(const AttemptFolder& folder, const std::string& attempt) = 0;
    virtual AtStop at_stop() const = 0;
    /// The cluster's last listing; nothing: there is no queue. Callable from any thread.
    virtual std::optional<std::vector<QueuedJob>> jobs() { return std::nullopt; }
};

}  // namespace breach::orchestrator
