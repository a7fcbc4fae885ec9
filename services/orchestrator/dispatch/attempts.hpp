// The attempts that may have a process: starts, watches, retries, stops and settles them. Stores
// every decision before it acts, so that a restart only needs the store and the running processes.
#pragma once

#include <chrono>
#include <functional>
#include <list>

#include "services/orchestrator/dispatch/clock_of_day.hpp"
#include "services/orchestrator/dispatch/live_attempt.hpp"
#include "services/orchestrator/dispatch/progress_board.hpp"
#include "services/orchestrator/executors/executor.hpp"
#include "services/orchestrator/files/folder_watch.hpp"

namespace breach::orchestrator {

class Attempts {
  public:
    /// settings: must outlive this object. over: called with each task that is final or finalizing,
    /// to handle its outputs.
    Attempts(Store& store, const DataFolder& data, Executor& executor, ProgressBoard& board,
             const DispatchSettings& settings, std::function<void(const Task&)> over)
        : store_(store),
          data_(data),
          executor_(executor),
          board_(board),
          settings_(settings),
          over_(std::move(over)) {}

    /// Replaces its state by the attempts in progress according to the store.
    void adopt();
    /// One commit before the processes are started and one after, for all of them.
    void start(const std::vector<Task>& tasks);
    /// Checks attempts whose folders changed; once a second, all attempts.
    void look();
    /// Asks all attempts to end, because the service stops.
    void stop_all();

    bool empty() const { return live_.empty(); }
    /// Free capacity.
    Capacity capacity() const;
    /// Readable when one of their folders has changed.
    int descriptor() const { return watch_.descriptor(); }
    /// Seconds from ready to the handover to the executor; from the snapshot's appearance on the
    /// disk to the start of the task that waited for it.
    const Histogram& queue_wait() const { return queue_wait_; }
    const Histogram& snapshot_to_start() const { return snapshot_to_start_; }

  private:
    LiveAttempt& attach(const Task& task, std::int64_t number);
    bool hand_over(LiveAttempt& live);
    void note_latency(const Task& task);
    void stop_cancelled();
    void observe(LiveAttempt& live);
    void read_lines(LiveAttempt& live);
    void note(LiveAttempt& live, AttemptEvent event, bool LiveAttempt::*noted);
    void note_starts(const std::vector<LiveAttempt*>& started);
    void note_exit(LiveAttempt& live);
    void note_loss(LiveAttempt& live, const std::string& why);
    void retry_or_give_up(Transaction& transaction, const LiveAttempt& live, TaskEvent retry,
                          TaskEvent give_up, const TaskFault& fault);
    void settle(LiveAttempt& live);
    void stop_watching(const LiveAttempt& live);
    void forget_the_ended();

    Store& store_;
    const DataFolder& data_;
    Executor& executor_;
    ProgressBoard& board_;
    const DispatchSettings& settings_;
    std::function<void(const Task&)> over_;
    FolderWatch watch_;
    std::list<LiveAttempt> live_;
    std::chrono::steady_clock::time_point looked_at_all_{};
    ClockOfDay clock_;
    Histogram queue_wait_{{0.01, 0.03, 0.1, 0.3, 1, 3, 10, 60, 600, 3600}};
    Histogram snapshot_to_start_{{0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 5, 30}};
};

}  // namespace breach::orchestrator
