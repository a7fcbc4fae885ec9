// Moves the runs on: gives ready tasks to the executor, watches their attempts, releases what waits
// for a file or a parent, retries, stops what is cancelled. One thread; every decision is stored
// before it is acted upon, so that a restart only has to look at the store and at what is really
// running.
#pragma once

#include <atomic>
#include <chrono>
#include <list>
#include <map>
#include <mutex>
#include <set>
#include <thread>

#include "services/orchestrator/dispatch/cache.hpp"
#include "services/orchestrator/dispatch/clock_of_day.hpp"
#include "services/orchestrator/dispatch/progress_board.hpp"
#include "services/orchestrator/dispatch/registrar.hpp"
#include "services/orchestrator/ensemble/batch_watch.hpp"
#include "services/orchestrator/executors/executor.hpp"
#include "services/orchestrator/files/data_folder.hpp"
#include "services/orchestrator/files/folder_watch.hpp"
#include "services/orchestrator/store/store.hpp"
#include "services/orchestrator/triggers/trigger_watch.hpp"

namespace breach::orchestrator {

struct DispatchSettings {
    std::filesystem::path bin;   ///< folder of the phase executables
    std::size_t slots = 1;       ///< cores that attempts may occupy together
    std::int64_t memory_mb = 0;  ///< that attempts may ask for together; 0: not limited
    std::map<std::string, std::size_t> limits;  ///< attempts at the same time, by phase
    double grace_seconds = 5;                   ///< between TERM and KILL
    std::int64_t most_tries = 4;
    std::chrono::milliseconds retry_delay{500};  ///< doubled with each further try
    Numerics numerics = {};                      ///< of the programs in `bin`, as they say it
};

/// Wakes the dispatcher's thread out of its poll; may be rung by any thread.
class Bell {
  public:
    Bell();
    ~Bell();
    Bell(const Bell&) = delete;
    Bell& operator=(const Bell&) = delete;
    void ring() const;
    void silence() const;
    int descriptor() const { return descriptor_; }

  private:
    int descriptor_;
};

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
    /// Seconds from ready to given to the executor; from the snapshot's appearance on its disk to
    /// the start of what waited for it.
    const Histogram& queue_wait() const { return queue_wait_; }
    const Histogram& snapshot_to_start() const { return snapshot_to_start_; }

  private:
    /// An attempt that may have a process.
    struct Live {
        Task task;
        std::int64_t number;
        AttemptFolder folder;
        bool resumes;  ///< goes on from the checkpoint of an earlier attempt, if there is one
        int attempt_watch;
        int output_watch;
        std::streamoff lines_read = 0;
        bool submission_noted = false;  ///< the executor's taking it, in the attempt's row
        bool start_noted = false;       ///< its process, in the task's row
        bool begun = false;
        bool outputs_changed = true;  ///< a new file may release a child
        bool asked_to_stop = false;
        bool over = false;
    };

    void serve(const std::stop_token& stop);
    void reconcile();
    void look_around();
    void wait_for_something();
    void shut_down();

    void start_ready_tasks();
    std::vector<Task> tasks_that_fit();
    bool leave_to_the_cache(const Task& task);
    bool waits_for_an_equal(const Task& task, const std::vector<Task>& chosen) const;
    void start(const std::vector<Task>& tasks);
    void link_files(const std::string& run);
    bool hand_over(Live& live);
    void note_starts(const std::vector<Live*>& started);
    void note_latency(const Task& task);
    bool may_resume(const std::string& task, std::int64_t number) const;
    Order order_for(const Live& live) const;
    Live& attach(const Task& task, std::int64_t number);

    void observe_alone(Live& live);
    void observe(Live& live);
    void read_lines(Live& live);
    void note_submission(Live& live);
    void note_start(Live& live);
    void note_begin(Live& live);
    void note_exit(Live& live);
    void note_loss(Live& live, const std::string& why);
    void retry_or_give_up(Transaction& transaction, const Live& live, TaskEvent retry,
                          TaskEvent give_up, const TaskFault& fault);
    TaskFault fault_of(const Live& live, const ExitRecord& record) const;
    bool is_over(const std::string& task) const;
    void stop_watching(const Live& live);
    void forget_the_ended();

    void stop_cancelled();
    void release_retries();
    /// Releases or skips what waits for this task, and what waits for that.
    void settle_children(const std::string& parent);
    void settle_after_registrar();

    Store& store_;
    const DataFolder& data_;
    Executor& executor_;
    ProgressBoard& board_;
    DispatchSettings settings_;
    FolderWatch watch_;
    TriggerWatch triggers_;
    BatchWatch batches_;
    Bell bell_;             // before those whose threads ring it: it goes after them
    std::stop_token stop_;  ///< of the serving thread
    std::list<Live> live_;
    std::chrono::steady_clock::time_point looked_at_all_{};
    std::chrono::steady_clock::time_point round_began_{};

    std::mutex registered_mutex_;
    std::vector<std::string> registered_;         ///< tasks that the registrar has finished with
    std::vector<LookedUp> looked_up_;             ///< tasks that the cache has finished with
    std::set<std::string> in_the_cache_;          ///< ready tasks that the cache looks up now
    std::map<std::string, LookedUp> not_cached_;  ///< ready tasks that nothing found answers
    std::set<std::string> wait_for_equals_;       ///< ready tasks, in the last round
    std::atomic<bool> unsettled_ = false;
    ClockOfDay clock_;
    Histogram queue_wait_{{0.01, 0.03, 0.1, 0.3, 1, 3, 10, 60, 600, 3600}};
    Histogram snapshot_to_start_{{0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 5, 30}};
    Registrar registrar_;
    Cache cache_;
    std::jthread thread_;  // last: stops before what it uses goes
};

}  // namespace breach::orchestrator
