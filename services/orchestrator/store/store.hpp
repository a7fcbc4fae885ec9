// The service's database behind one interface. A single writer thread owns the only writing
// connection and commits queued changes together (group commit); readers have read-only
// connections. SQLite 3.40 can corrupt when two connections write or checkpoint at once, hence one
// writer.
#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <future>
#include <map>
#include <mutex>
#include <thread>

#include "services/orchestrator/records/result_columns.hpp"
#include "services/orchestrator/records/time_left.hpp"
#include "services/orchestrator/store/histogram.hpp"
#include "services/orchestrator/store/recent_events.hpp"
#include "services/orchestrator/store/transaction.hpp"

namespace breach::orchestrator {

/// The run of an Idempotency-Key.
struct IdempotentRun {
    std::string body_sha256;
    std::string run;
};

/// A run or task that existed a moment ago was removed meanwhile.
struct RemovedMeanwhile : std::runtime_error {
    RemovedMeanwhile() : std::runtime_error("a run was removed while this was read") {}
};

/// The value, which exists unless its run was removed meanwhile.
template <class T>
T unless_removed(std::optional<T> found) {
    if (!found) throw RemovedMeanwhile();
    return std::move(*found);
}

class Store {
  public:
    explicit Store(const std::filesystem::path& file);
    ~Store();
    Store(const Store&) = delete;
    Store& operator=(const Store&) = delete;

    /// Runs `change`, and returns its result when it is on the disk. Rethrows its exception after
    /// undoing the whole change. Throws StoreError when the commit fails. by: see Transaction.
    template <class Change>
    auto write(const std::string& by, const Change& change) {
        using Made = std::invoke_result_t<const Change&, Transaction&>;
        if constexpr (std::is_void_v<Made>) {
            wait_for(change, by);
        } else {
            std::optional<Made> made;
            wait_for([&](Transaction& transaction) { made = change(transaction); }, by);
            return *std::move(made);
        }
    }
    template <class Change>
    auto write(const Change& change) {
        return write({}, change);
    }

    std::vector<Run> runs(std::size_t most) const;
    std::vector<Run> runs(const RunFilter& filter, std::size_t most) const;
    std::optional<IdempotentRun> run_of_key(const std::string& key) const;
    std::optional<Run> run(const std::string& id) const;
    /// The same with the state of a sweep (RunFilter::sweeps_only).
    std::optional<Run> sweep(const std::string& id) const;
    /// Tasks of the run that have not ended, by phase, and how long recent tasks took.
    std::vector<PhaseLeft> left_of(const std::string& run) const;
    /// Time since the run's creation with at least one of its attempts running, and without any
    /// [s].
    std::pair<double, double> computing_and_idle(const Run& run) const;
    std::optional<nlohmann::json> study_of(const std::string& run) const;
    /// By the name of a repeat, the variant that it repeats: "soft_d2" and "soft" -> "soft".
    std::map<std::string, std::string> repeated_variants(const std::string& run) const;
    std::optional<std::string> scene_of(const std::string& run) const;

    std::optional<Task> task(const std::string& id) const;
    /// Ready tasks in the order in which they start: by priority, then by age. Leaves out paused
    /// runs and full queues (phases).
    std::vector<Task> tasks_to_start(const std::vector<std::string>& full_queues,
                                     std::size_t most) const;
    /// Whether an earlier task with this recipe succeeded or broke down, so that its input may be
    /// the same.
    bool has_candidate(const Task& task) const;
    /// Tasks that succeeded or broke down with this recipe and input, newest first.
    std::vector<Task> answers_to(const std::string& recipe, const std::string& input_sha256,
                                 std::size_t most) const;
    /// A task in progress with this one's recipe and input: its result will be used.
    std::optional<std::string> equal_in_flight(const Task& task) const;
    std::optional<Recipe> recipe(const std::string& hash) const;
    std::optional<Task> earlier_equal_recipe(const Task& task) const;
    /// Other recipes of the phase that were used before this task, newest first, with the last task
    /// that used them.
    std::vector<std::pair<std::string, Recipe>> earlier_recipes(const Task& task,
                                                                std::size_t most) const;
    std::map<std::string, std::int64_t> tasks_by_state() const;
    std::map<std::string, std::int64_t> attempts_by_state() const;
    std::vector<Task> tasks_of(const std::string& run) const;
    /// The stability analysis of this variant, or of all variants; for a FEM shared by variants
    /// with several analyses, the first one.
    std::optional<Task> stability_of(const std::string& run, const std::string& variant,
                                     const std::string& phase) const;
    /// The tasks after the id `after`, in the order of their ids.
    std::vector<Task> tasks_of(const std::string& run, const std::string& after,
                               std::size_t most) const;
    /// For each phase up to `most` tasks that succeeded by computing, evenly spread over transfer
    /// times and variants.
    std::vector<Task> computed_tasks_of(const std::string& run, std::size_t most) const;
    std::vector<Task> tasks_in(TaskState state, std::size_t most) const;
    /// Blocked tasks whose input comes from `parent`.
    std::vector<BlockedTask> blocked_children(const std::string& parent) const;
    std::vector<std::string> parents_of_blocked() const;
    /// When the task last became ready [ms since 1970].
    std::optional<std::int64_t> ready_at(const std::string& task) const;
    /// Ids of tasks whose retry time is not after `now`, and the earliest later one.
    std::vector<std::string> due_retries(std::int64_t now) const;
    std::optional<std::int64_t> next_retry() const;

    std::vector<Attempt> attempts_of(const std::string& task) const;
    std::vector<Artifact> artifacts_of(const std::string& task) const;
    /// Attempts and artifacts of the tasks from the id `first` to the id `last`, by task.
    std::map<std::string, std::vector<Attempt>> attempts_between(const std::string& first,
                                                                 const std::string& last) const;
    std::map<std::string, std::vector<Artifact>> artifacts_between(const std::string& first,
                                                                   const std::string& last) const;
    std::optional<Artifact> artifact(const std::string& sha256) const;
    /// Newest first.
    std::vector<TransferRow> transfers_of(const TransferFilter& filter, std::size_t most) const;
    /// In the study's order of variants, each ascending in the transfer time.
    std::vector<ResultRow> results(const std::string& run, const ResultFilter& filter = {}) const;
    /// The means of a study with repeats, in the same order: one value per mean_columns().
    std::vector<ResultRow> means(const std::string& run) const;
    /// By variant; "": the analysis shared by all variants without their own.
    std::map<std::string, FactorsOfSafety> factors_of_safety(const std::string& run) const;
    /// From the newest accuracy studies, the newest first.
    std::vector<AccuracyRung> accuracy_rungs(std::size_t most_runs) const;
    /// Points of a sweep, and how many of them have their runout.
    std::pair<std::int64_t, std::int64_t> points_of(const std::string& run) const;

    /// Open triggers of FEMs that have begun.
    std::vector<Trigger> open_triggers() const;
    /// Whether the run stores the tasks of one more transfer from this FEM.
    bool plans_transfers_of(const Task& fem) const;
    std::vector<Batches> open_batches() const;
    /// Nothing: the study adds no samples by itself.
    std::optional<Batches> batches_of(const std::string& run) const;
    std::vector<Trigger> triggers_of(const std::string& run) const;
    std::vector<FiringRow> firings_of(const std::string& run) const;
    /// In the order of the run's plan.
    std::vector<WithoutTransfer> without_transfer(const std::string& run) const;
    /// A bisection's transfers, ascending in time; where variants share a transfer, the first
    /// variant counts.
    std::vector<Sample> samples_of(const std::string& trigger) const;

    /// Runs with deleted rows and folders that may still exist.
    std::vector<std::string> removals() const;
    /// Runs that are over, the one that ended first at the front.
    std::vector<Run> runs_that_may_go() const;
    std::int64_t free_pages() const;
    /// Uploaded files, newest first, with the runs that name them.
    std::vector<StoredFile> files() const;
    std::optional<StoredFile> file(const std::string& sha256) const;
    std::vector<StoredFile> files_of(const std::string& run) const;
    /// Files that no run names and that were not requested since.
    std::vector<StoredFile> unused_files(const std::string& before) const;

    std::vector<Event> events_after(std::int64_t seq, std::size_t most) const;
    std::vector<Event> events_of_run(const std::string& run, std::int64_t after,
                                     std::size_t most) const;
    /// Number of state changes per commit.
    const Histogram& commit_sizes() const { return commit_sizes_; }
    std::int64_t last_event() const { return last_event_; }
    /// Waits for an event after `seq`, until the time is over; true: there is an event. A caller
    /// that may have to stop waits in slices.
    bool wait_for_event(std::int64_t seq, std::chrono::milliseconds longest) const;

  private:
    struct Job {
        std::function<void(Transaction&)> change;
        std::string by;
        std::promise<void> done;
        std::exception_ptr refused;
    };
    void wait_for(std::function<void(Transaction&)> change, const std::string& by);
    void serve(const std::stop_token& stop);
    void commit(std::deque<Job>& jobs);
    /// Returns a reading connection to the pool on destruction.
    struct GiveBack {
        const Store* store;
        void operator()(Connection* connection) const;
    };
    using Reader = std::unique_ptr<Connection, GiveBack>;
    Reader reader() const;
    /// Complete runs with their facts; sql: selects the rows.
    std::vector<Run> whole_runs(const std::string& sql, const std::vector<Value>& values) const;
    std::optional<Run> one_run(const std::string& id, const std::string& state) const;
    static void gather_facts(Connection& database, std::vector<Run>& runs);

    Histogram commit_sizes_{{1, 2, 5, 10, 20, 50, 100, 256}};
    std::filesystem::path file_;
    Connection writing_;
    std::mutex jobs_mutex_;
    std::condition_variable_any jobs_arrived_;
    std::deque<Job> jobs_;

    mutable std::mutex readers_mutex_;
    mutable std::vector<std::unique_ptr<Connection>> idle_readers_;

    mutable std::mutex events_mutex_;
    mutable std::condition_variable event_stored_;
    std::atomic<std::int64_t> last_event_ = 0;
    RecentEvents recent_events_;

    std::jthread writer_;  // last: stops before the members it uses are destroyed
};

}  // namespace breach::orchestrator
