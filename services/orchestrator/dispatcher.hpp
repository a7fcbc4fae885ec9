// Moves the runs on: gives ready tasks to the executor, watches their attempts, releases what waits
// for a file or a parent, retries, stops what is cancelled. One thread; every decision is stored
// before it is acted upon, so that a restart only has to look at the store and at what is really
// running.
#pragma once

#include <chrono>
#include <list>
#include <mutex>
#include <thread>

#include "services/orchestrator/data_folder.hpp"
#include "services/orchestrator/executors/executor.hpp"
#include "services/orchestrator/folder_watch.hpp"
#include "services/orchestrator/progress_board.hpp"
#include "services/orchestrator/registrar.hpp"
#include "services/orchestrator/store/store.hpp"

namespace breach::orchestrator {

struct DispatchSettings {
    std::filesystem::path bin;  ///< folder of the phase executables
    std::size_t slots = 1;      ///< attempts at the same time
    double grace_seconds = 5;   ///< between TERM and KILL
    std::int64_t most_tries = 4;
    std::chrono::milliseconds retry_delay{500};  ///< doubled with each further try
};

class Dispatcher {
  public:
    Dispatcher(Store& store, const DataFolder& data, Executor& executor, ProgressBoard& board,
               DispatchSettings settings);
    /// Stops the running attempts with their checkpoints saved; the next start goes on with them.
    ~Dispatcher();
    Dispatcher(const Dispatcher&) = delete;
    Dispatcher& operator=(const Dispatcher&) = delete;

    /// Look again: a run was submitted or cancelled.
    void wake();

  private:
    /// An attempt that may have a process.
    struct Live {
        Task task;
        std::int64_t number;
        AttemptFolder folder;
        int attempt_watch;
        int output_watch;
        std::streamoff lines_read = 0;
        bool submission_noted = false;
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
    void start(const Task& task);
    Order order_for(const Live& live) const;
    Live& attach(const Task& task, std::int64_t number);

    void observe(Live& live);
    void read_lines(Live& live);
    void note_submission(Live& live);
    void note_begin(Live& live);
    void note_exit(Live& live);
    void note_loss(Live& live, const std::string& why);
    void retry_or_give_up(Transaction& transaction, const Live& live, TaskEvent retry,
                          TaskEvent give_up, const TaskFault& fault);
    TaskFault fault_of(const Live& live, const ExitRecord& record) const;
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
    int wake_descriptor_;
    std::list<Live> live_;
    std::chrono::steady_clock::time_point looked_at_all_{};

    std::mutex registered_mutex_;
    std::vector<std::string> registered_;  ///< tasks that the registrar has finished with
    Registrar registrar_;
    std::jthread thread_;  // last: stops before what it uses goes
};

}  // namespace breach::orchestrator
