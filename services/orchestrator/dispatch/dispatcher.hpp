// Advances the runs, on one thread, round by round: watches the attempts, releases waiting tasks,
// adds tasks for triggers and batches, starts ready tasks that fit.
#pragma once

#include <atomic>
#include <chrono>
#include <thread>

#include "services/orchestrator/dispatch/attempts.hpp"
#include "services/orchestrator/dispatch/ready_tasks.hpp"
#include "services/orchestrator/dispatch/registrar.hpp"
#include "services/orchestrator/triggers/trigger_watch.hpp"
#include "services/orchestrator/uncertainty/batch_watch.hpp"

namespace breach::orchestrator {

class Dispatcher {
  public:
    Dispatcher(Store& store, const DataFolder& data, Executor& executor, ProgressBoard& board,
               DispatchSettings settings);
    ~Dispatcher();
    Dispatcher(const Dispatcher&) = delete;
    Dispatcher& operator=(const Dispatcher&) = delete;

    /// Stops the running attempts after they saved checkpoints; the next start continues them.
    void stop();
    /// Starts a new round: a run was submitted or cancelled.
    void wake();
    /// Checks every blocked task again, after an order or new tasks.
    void settle_all();
    const DispatchSettings& settings() const { return settings_; }
    /// The executor's queue; nothing: it has none.
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
    Notifier notifier_;                // before those whose threads notify it: destroyed after them
    Mailbox<std::string> registered_;  ///< tasks that the registrar has handled
    Registrar registrar_;
    Attempts attempts_;
    ReadyTasks ready_;
    TriggerWatch triggers_;
    BatchWatch batches_;
    std::chrono::steady_clock::time_point round_began_{};
    std::atomic<bool> unsettled_ = false;
    std::jthread thread_;  // last: stops before the members it uses are destroyed
};

}  // namespace breach::orchestrator
