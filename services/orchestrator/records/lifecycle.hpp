// The one state table: every state of a task and of an attempt, every event that may move it, and
// the new state. Nothing else in the service decides a state. store/ implements the events on disk
// and in SQL.
#pragma once

#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace breach::orchestrator {

/// States: who moves a task on, and what a restart of the service does.
///
///     blocked      waits for a parent's output; the dispatcher releases or skips it.
///                  Restart: looks again for the file or the parent's end.
///     ready        waits for a slot; the dispatcher claims it. Restart: nothing to do.
///     cached       final: an equal task had been done before.
///     starting     its attempt's row is stored, its process is perhaps started.
///                  Restart: checks the attempt's lock.
///     running      its process is known to run. Restart: checks the lock and the exit record.
///     finalizing   its process ended well, its outputs are being hashed. Restart: hashes again.
///     succeeded    final.
///     failed       final, until a user's redo.
///     lost         its process vanished without a record; moved on in the same transaction.
///     retry_wait   waits until its retry time. Restart: goes on waiting.
///     cancelling   its process is being stopped. Restart: stops it again.
///     cancelled    final, until a user's redo.
///     skipped      final, until a user's redo: its parent will never deliver the input.
enum class TaskState {
    blocked,
    ready,
    cached,
    starting,
    running,
    finalizing,
    succeeded,
    failed,
    lost,
    retry_wait,
    cancelling,
    cancelled,
    skipped,
};

enum class TaskEvent {
    release,          ///< the input exists
    skip,             ///< the input will never exist
    reuse,            ///< the result is in the cache
    reuse_breakdown,  ///< an equal task broke down (exit code 70) and this one would, too
    claim,            ///< a slot was given; stored before anything is started
    start,            ///< the process was started
    exit_well,        ///< exit code 0
    exit_badly,       ///< an exit code with which a retry would fail, too
    exit_retryable,   ///< an exit code or signal with which a retry may succeed
    interrupt,        ///< stopped because the service stops; not the task's fault
    vanish,           ///< no process and no exit record
    retry,            ///< lost, and tried again
    give_up,          ///< lost, and tried often enough
    wait_over,        ///< the retry time has come
    keep_outputs,     ///< outputs hashed and stored
    refuse_outputs,   ///< the outputs promised are not there
    cancel,           ///< asked for by a user
    stopped,          ///< the process asked to stop is gone
    redo,             ///< asked for by a user: what ended badly is tried again
};

/// Attempts (dispatch/attempts.cpp) creates a row as `submitting`, in the transaction that claims
/// the task, and moves it: to `submitted` when the executor took it, to `running` at the phase's
/// first line of progress, to `exited` with its exit record, to `lost` if there is neither
/// process nor record. At most one attempt of a task is live. Rows stay until the run is removed;
/// its folder goes with the run.
enum class AttemptState { submitting, submitted, running, exited, lost };

enum class AttemptEvent {
    submit,  ///< the executor took it
    begin,   ///< first sign of life from the phase
    exit,    ///< its exit record was read
    vanish,  ///< no process and no exit record
};

struct TaskRule {
    TaskState from;
    TaskEvent event;
    TaskState to;
};

struct AttemptRule {
    AttemptState from;
    AttemptEvent event;
    AttemptState to;
};

/// All that is allowed; every other pair is refused.
std::span<const TaskRule> task_rules();

std::span<const TaskState> all_task_states();
std::span<const TaskEvent> all_task_events();
std::span<const AttemptState> all_attempt_states();
std::span<const AttemptEvent> all_attempt_events();

std::optional<TaskState> next(TaskState from, TaskEvent event);
std::optional<AttemptState> next(AttemptState from, AttemptEvent event);

/// Only a user's redo moves it any more.
bool is_final(TaskState state);
/// Its output exists: computed, or taken from an equal task.
bool has_output(TaskState state);
/// The attempt may still have a process.
bool is_live(AttemptState state);

std::string_view name_of(TaskState state);
std::string_view name_of(TaskEvent event);
std::string_view name_of(AttemptState state);
std::string_view name_of(AttemptEvent event);
TaskState task_state_named(std::string_view name);
AttemptState attempt_state_named(std::string_view name);

/// An event that the table does not allow in this state.
class IllegalMove : public std::logic_error {
  public:
    using std::logic_error::logic_error;
};

}  // namespace breach::orchestrator
