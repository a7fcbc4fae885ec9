// Attempts as jobs of a Slurm cluster, each below the same supervisor as on this machine. A thread
// of its own talks to Slurm, so that a controller that does not answer delays nothing else.
//
// The state of an attempt comes first from its own folder (exit record, lock, heartbeat), which all
// nodes see, and then from Slurm. A job that Slurm does not list is unknown, not finished: it
// counts as gone only after a grace time without any sign of life.
#pragma once

#include <condition_variable>
#include <map>
#include <mutex>
#include <optional>
#include <thread>

#include "services/orchestrator/executors/executor.hpp"
#include "services/orchestrator/executors/slurm_commands.hpp"

namespace breach::orchestrator {

struct SlurmSettings {
    std::vector<std::string> options;  ///< further words for sbatch
    double poll_seconds = 5;           ///< between two looks at the queue
    double grace_seconds = 60;         ///< without a sign of life before an attempt is given up
    double command_seconds = 30;       ///< time limit of one command
    std::size_t throttle = 0;          ///< tasks of one array at the same time; 0: no limit
};

class SlurmExecutor final : public Executor {
  public:
    /// `self`: the breachline executable; the nodes must see it under this path.
    SlurmExecutor(SlurmSettings settings, const std::filesystem::path& self);
    ~SlurmExecutor() override;

    void submit(const AttemptFolder& folder, const Order& order) override;
    Vitals probe(const AttemptFolder& folder) override;
    void stop(const AttemptFolder& folder, StopReason reason) override;
    void clear_away(const AttemptFolder& folder, const std::string& attempt) override;
    /// The cluster continues without the service; the next one finds the jobs again.
    AtStop at_stop() const override { return AtStop::leaves_them; }

    std::optional<std::vector<QueuedJob>> jobs() override;

  private:
    using Clock = std::chrono::steady_clock;

    /// submit() creates a job in `waiting`. open_round moves it to `asking`, close_round to
    /// `submitted`, `refused` or `doubtful`. recover_the_unanswered moves `asking` to `doubtful`
    /// after an error of the clerk. take_in moves `doubtful` by the queue's listing: to
    /// `submitted`, or back to `waiting`. stop() moves `waiting` to `refused`. probe() erases a
    /// job with an exit record, clear_away() and cancel_the_unwanted() those that were given up.
    enum class Stage {
        waiting,    ///< for its sbatch
        asking,     ///< its sbatch runs now
        doubtful,   ///< its sbatch gave no clear answer: only the queue can say
        submitted,  ///< Slurm has it, or had it
        refused,    ///< there is no job, and there will be none
    };

    /// An attempt submitted to this executor.
    struct Job {
        AttemptFolder folder;
        Order order = {};
        JobName name = {};
        Stage stage = Stage::waiting;
        std::string state = {};     ///< Slurm's word when it was last listed
        std::string reason = {};    ///< Slurm's word for why it waits
        std::string number = {};    ///< Slurm's number for it when it was last listed
        std::string why = {};       ///< why it was refused, or is uncertain
        int asked = 0;              ///< how often sbatch was called for it
        Clock::time_point since{};  ///< of this stage
        /// Start of the silence: no lock, no heartbeat, and not listed, or listed as over or as
        /// running.
        std::optional<Clock::time_point> silent_since = {};
        std::optional<std::filesystem::file_time_type> heartbeat = {};
        Clock::time_point heart_beat_at{};
        std::optional<Clock::time_point> unwanted_since = {};
        bool given_up = false;  ///< no longer needed

        std::string what_keeps() const;
        bool heart_beats();
        bool is_due_for_scancel() const;
    };
    using Jobs = std::map<std::filesystem::path, Job>;

    void serve(const std::stop_token& stop);
    void submit_what_waits();
    void submit_together(const std::vector<std::filesystem::path>& roots);
    Batch open_round(const std::vector<std::filesystem::path>& roots);
    Submitted ask(const Batch& batch) const;
    void close_round(const Batch& batch, const Submitted& answer);
    void recover_the_unanswered();
    void look_at_the_queue();
    void take_in(Job& job, const std::map<JobName, ListedJob>& listed, Clock::time_point asked);
    bool must_be_found();
    bool cancel_the_unwanted();
    /// Requests a look before the next regular one; call with the lock held.
    void look_soon();
    Job* find_or_adopt(const AttemptFolder& folder);
    Vitals vitals_of(Job& job) const;
    Clock::duration grace() const;

    SlurmSettings settings_;
    SlurmCommands slurm_;
    std::mutex mutex_;
    std::condition_variable_any news_;
    Jobs jobs_;
    bool looks_soon_ = false;  ///< a look before the next regular one is due
    bool answers_ = true;      ///< Slurm answered the last time
    std::jthread clerk_;       // last: stops before the members it uses are destroyed
};

}  // namespace breach::orchestrator
