// The attempts that may have a process: starts, watches, retries, stops and settles them. Every
// decision is stored before it is acted upon, so that a restart only has to look at the store and at
// what is really running.
#pragma once

#include <chrono>
#include <functional>
#include <list>

#include "services/orchestrator/dispatch/capacity.hpp"
#include "services/orchestrator/dispatch/live_attempt.hpp"
#include "services/orchestrator/dispatch/progress_board.hpp"
#include "services/orchestrator/dispatch/start_latency.hpp"
#include "services/orchestrator/executors/executor.hpp"
#include "services/orchestrator/files/folder_watch.hpp"

namespace breach::orchestrator {

class Attempts {
  public:
    /// settings: outlive it. over: called with each task that has ended, for its outputs.
    Attempts(Store& store, const DataFolder& data, Executor& executor, ProgressBoard& board,
             const DispatchSettings& settings, std::function<void(const Task&)> over)
        : store_(store),
          data_(data),
          executor_(executor),
          board_(board),
          settings_(settings),
          over_(std::move(over)) {}

    /// In place of what it knows: what the store says was going on.
    void adopt();
    /// One commit before the processes are started and one after, for all of them.
    void start(const std::vector<Task>& tasks);
    /// Looks at those whose folders have changed, and once a second at all.
    void look();
    /// Asks all to end because the service does.
    void stop_all();

    bool empty() const { return live_.empty(); }
    /// That they leave.
    Capacity capacity() const;
    /// Readable when a folder of theirs has changed.
    int descriptor() const { return watch_.descriptor(); }
    const StartLatency& latency() const { return latency_; }

  private:
    LiveAttempt& attach(const Task& task, std::int64_t number);
    bool hand_over(LiveAttempt& live);
    void stop_cancelled();
    void observe_alone(LiveAttempt& live);
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
    StartLatency latency_;
};

}  // namespace breach::orchestrator
