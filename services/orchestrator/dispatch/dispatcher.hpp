// Moves the runs on, on one thread, round by round: watches the attempts, releases what waits, asks
// triggers and batches for more tasks, starts what is ready and fits.
#pragma once

#include <atomic>
#include <chrono>
#include <thread>

#include "services/orchestrator/dispatch/attempts.hpp"
#include "services/orchestrator/dispatch/ready_tasks.hpp"
#include "services/orchestrator/dispatch/registrar.hpp"
#include "services/orchestrator/ensemble/batch_watch.hpp"
#include "services/orchestrator/triggers/trigger_watch.hpp"

namespace breach::orchestrator {

class Dispatcher {
  public:
    Dispatcher(Store& store, const DataFolder& data, Executor& executor, ProgressBoard& board,
               DispatchSettings settings);
    ~Dispatcher();
    Dispatcher(const Dispatcher&) = delete;
    Dispatcher& operator=(const Dispatcher&) = delete;

    /// Stops the running attempts with their checkpoints saved; the next start goes on with them.
    void stop();
    /// Look again: a run was submitted or cancelled.
    void wake();
    /// Look at every blocked task again: some were set back.
    void settle_all();
    const DispatchSettings& settings() const { return settings_; }
    /// Of the executor; nothing: it has no queue of its own.
    std::optional<std::vector<QueuedJob>> jobs() const { return executor_.jobs(); }
    const Histogram& queue_wait() const { return attempts_.queue_wait(); }
    const Histogram& snapshot_to_start() const { return attempts_.snapshot_to_start(); }

  private:
    void serve(const std::stop_token& stop);
    void reconcile(const std::stop_token& stop);
    void look_around(const std::stop_token& stop);
    void start_ready_tasks();
    void wait_for_something();
    void shut_down(const std::stop_token& stop);

    Store& store_;
    const DataFolder& data_;
    Executor& executor_;
    DispatchSettings settings_;
    Notifier notifier_;                // before those whose threads notify it: it goes after them
    Mailbox<std::string> registered_;  ///< tasks that the registrar has finished with
    Registrar registrar_;
    Attempts attempts_;
    ReadyTasks ready_;
    TriggerWatch triggers_;
    BatchWatch batches_;
    std::chrono::steady_clock::time_point round_began_{};
    std::atomic<bool> unsettled_ = false;
    std::jthread thread_;  // last: stops before what it uses goes
};

}  // namespace breach::orchestrator
