// What may be written, one verb per change of state. Each verb stores its event with the change;
// the lifecycle's table decides the new state. A Transaction exists only inside Store::write.
#pragma once

#include "services/orchestrator/records.hpp"
#include "services/orchestrator/store/connection.hpp"

namespace breach::orchestrator {

/// How an attempt ended, from its exit record.
struct AttemptEnd {
    std::optional<std::int64_t> exit_code;
    std::optional<std::int64_t> signal;
    std::optional<double> wall_seconds;
    std::optional<double> cpu_seconds;
    std::string reason;  ///< "cancel", "shutdown" when the service stopped it; else empty
};

class Transaction {
  public:
    explicit Transaction(Connection& database) : database_(database) {}

    void add_run(const NewRun& run);

    /// Moves the task; throws IllegalMove when the table refuses. `detail` goes into the event.
    TaskState move_task(const std::string& task, TaskEvent event, nlohmann::json detail = {});
    /// The same, but a refusal is an expected outcome (the task moved meanwhile): nothing happens.
    std::optional<TaskState> try_move_task(const std::string& task, TaskEvent event,
                                           nlohmann::json detail = {});
    void move_task_to_retry(const std::string& task, TaskEvent event, std::int64_t retry_at,
                            nlohmann::json detail);
    /// Ends the task without a result (exit_badly, give_up, refuse_outputs, skip) and keeps the
    /// reason.
    void fail_task(const std::string& task, TaskEvent event, const TaskFault& fault);
    void finish_task(const std::string& task, const nlohmann::json& result,
                     const std::vector<Artifact>& artifacts);

    /// The attempt's row, number one higher than the last; the task must have been claimed in this
    /// transaction.
    std::int64_t add_attempt(const std::string& task);
    void move_attempt(const std::string& task, std::int64_t number, AttemptEvent event,
                      const AttemptEnd& end = {});
    /// Counts an attempt against the task's limit; returns how many there are now.
    std::int64_t count_try(const std::string& task);

    /// Cancels what has not started and marks what runs as cancelling. False: no such run.
    bool cancel_run(const std::string& run, const std::string& why);

    std::int64_t last_event() const { return last_event_; }

  private:
    TaskState state_of(const std::string& task) const;
    void set_state(const std::string& task, TaskState from, TaskEvent event, TaskState to,
                   std::optional<std::int64_t> retry_at, nlohmann::json detail);
    void add_event(const std::string& run, const std::optional<std::string>& task,
                   const std::string& kind, const nlohmann::json& detail);

    Connection& database_;
    std::int64_t last_event_ = 0;
};

}  // namespace breach::orchestrator
