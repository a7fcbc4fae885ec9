// All write operations, one method per change of state. Each stores its event with the change; the
// lifecycle's table decides the new state. A Transaction exists only inside Store::write.
#pragma once

#include <functional>
#include <set>

#include "services/orchestrator/records/records.hpp"
#include "services/orchestrator/store/connection.hpp"

namespace breach::orchestrator {

struct AttemptEnd {
    std::optional<std::int64_t> exit_code;
    std::optional<std::int64_t> signal;
    std::optional<double> wall_seconds;
    std::optional<double> cpu_seconds;
    std::string
        reason;  ///< "cancel", "shutdown" (by the service), "signal" (by another party); else empty
};

class Transaction {
  public:
    /// by: requester, stored with the events of runs; empty: none, or unknown.
    explicit Transaction(Connection& database, std::string by = {})
        : database_(database), by_(std::move(by)) {}

    void add_run(const NewRun& run);
    void add_recipes(const std::vector<Recipe>& recipes);
    /// Remembers that `key` with this body made `run`. The database refuses a key twice.
    void keep_idempotency_key(const std::string& key, const std::string& body_sha256,
                              const std::string& run);

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
    /// Skips a task whose FEM ended regularly before its time: no failure, and a retry does not
    /// help. Keeps the reason. No effect when the task no longer waits.
    void pass_over_task(const std::string& task, const std::string& why);
    /// `input_sha256`: of the file that the task read; empty: it reads none.
    void finish_task(const std::string& task, const nlohmann::json& result,
                     const std::vector<Artifact>& artifacts, const std::string& input_sha256 = {});
    /// The task takes the result of `earlier`, or its breakdown; the files are in its folder
    /// already. False, without effect: the task is no longer ready, or `earlier` was removed or
    /// tried again meanwhile.
    bool reuse_task(const std::string& task, const Task& earlier);
    void note_cache_refusal(const std::string& task, const std::string& why);
    /// Stores the outputs of a task that ended badly. No effect if it was tried again meanwhile.
    void keep_remains(const std::string& task, const std::vector<Artifact>& artifacts,
                      const std::string& input_sha256);

    /// The attempt's row, number one higher than the last; the task must have been claimed in this
    /// transaction.
    std::int64_t add_attempt(const std::string& task);
    void move_attempt(const std::string& task, std::int64_t number, AttemptEvent event,
                      const AttemptEnd& end = {});
    /// Counts an attempt against the task's limit; returns how many there are now.
    std::int64_t count_try(const std::string& task);

    /// Cancels tasks not yet started and marks running ones as cancelling. False: no such run.
    bool cancel_run(const std::string& run, const std::string& why);
    /// Adds tasks to an existing run and replaces its study's document.
    void extend_run(const std::string& run, const Extension& extension);
    /// False: no such run.
    bool pause_run(const std::string& run);
    bool resume_run(const std::string& run);
    bool set_priority(const std::string& run, std::int64_t priority);
    /// Changes the title shown in lists; the study keeps its original title.
    bool rename_run(const std::string& run, const std::string& title);
    /// Deletes every row of an ended run at once: lists, cache and artifacts no longer contain it.
    /// Its folder must be removed next (Store::removals, forget_removal). The event "remove"
    /// remains, with `why`.
    Removal remove_run(const std::string& run, const std::string& why);
    void forget_removal(const std::string& run);

    /// `publish` gives the file its name in the folder. Like `erase` below it is called inside the
    /// transaction, so that row and file change together.
    void keep_file(const StoredFile& file, const std::function<void()>& publish);
    /// Marks the file as used now, which postpones its removal.
    void touch_file(const std::string& sha256);
    /// needed: a run names it.
    Removal forget_file(const std::string& sha256, const std::function<void()>& erase);
    /// Forgets the file unless it was used after `before` or a run names it.
    bool forget_unused_file(const std::string& sha256, const std::string& before,
                            const std::function<void()>& erase);

    /// Gives up to this many free pages at the end of the database back to the disk.
    void shrink(std::int64_t pages);
    /// Failed, cancelled and skipped tasks wait again, with a fresh count of tries; those whose
    /// process is still being stopped follow then (stop_task). Tasks that were not reached stay so. Re-arms triggers that the cancellation disarmed, and triggers that
    /// expired because of a task that now runs again (depends_on). Returns the number of tasks;
    /// nothing: no such run.
    std::optional<std::size_t> retry_run(const std::string& run);
    /// The process of a cancelled task has ended. After a retry in the meantime the task waits again.
    /// False: the task was not cancelled.
    bool stop_task(const std::string& task);

    /// Adds a trigger to one FEM of the run, with a generated name if it is empty. Returns its id.
    std::string add_trigger(const std::string& run, const std::string& fem_task,
                            const TriggerPlan& plan);
    /// False, without effect: the lifecycle forbids it (disarmed or fired meanwhile).
    bool move_trigger(const Trigger& trigger, TriggerEvent event, nlohmann::json detail = {});
    /// Stores the firing and its tasks. False, without effect: the trigger is not open any more, or
    /// fired at this time before.
    bool add_firing(const Trigger& trigger, const Firing& firing);
    void keep_trigger_result(const std::string& trigger, const nlohmann::json& result);

    bool batches_are_open(const std::string& run) const;
    /// Without effect on batches that have ended.
    void end_batches(const std::string& run, const std::string& state, const std::string& reason);

    /// Events of this transaction, oldest first.
    std::vector<Event> take_events() { return std::move(events_); }
    /// Whether the transaction has deleted earlier events.
    bool removes_events() const { return removes_events_; }

  private:
    std::string warnings_with(const std::string& run, const std::vector<fault::Flag>& more) const;
    void insert_task(const std::string& run, const std::string& id, const TaskPlan& task,
                     const std::optional<std::string>& parent, std::int64_t priority,
                     TaskState state);
    void redo_task(const std::string& task);
    std::int64_t next_ordinal(const std::string& run);
    void add_triggers(const NewRun& run);
    void add_samples(const std::string& run, const Extension& extension);
    void disarm_triggers(const std::string& run, const std::string& why);
    std::vector<Trigger> triggers_to_rearm(const std::string& run,
                                           const std::set<std::string>& tasks_tried_again) const;
    void add_transfer(const std::string& run, const std::string& fem_task, double time);
    bool mark_run(const std::string& run, const char* column, std::int64_t value,
                  const char* event);
    /// By a retry; those given up only where tasks run again, whose results may change the answer.
    void open_batches(const std::string& run, bool tasks_run_again);
    void add_files(const NewRun& run);
    TaskState state_of(const std::string& task) const;
    void set_state(const std::string& task, TaskState from, TaskEvent event, TaskState to,
                   std::optional<std::int64_t> retry_at, nlohmann::json detail);
    void add_run_event(const std::string& run, nlohmann::json detail) {
        add_event(run, std::nullopt, "run", std::move(detail));
    }
    void add_event(const std::string& run, const std::optional<std::string>& task,
                   const std::string& kind, nlohmann::json detail);

    Connection& database_;
    std::string by_;
    std::vector<Event> events_;
    bool removes_events_ = false;
};

}  // namespace breach::orchestrator
