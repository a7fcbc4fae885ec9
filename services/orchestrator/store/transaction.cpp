// Operations within one transaction, on the writer's thread (store.cpp). Each checks the present
// state of what it changes, as the caller decided on an older snapshot: try_ operations and those
// that return bool let the caller learn that a cancel or removal came first. Every change writes
// an event in the same transaction.
#include "services/orchestrator/store/transaction.hpp"

#include "core/phases/phases.hpp"
#include "services/orchestrator/records/identity.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

/// The initial state: only tasks that wait for nothing are ready.
TaskState first_state(const TaskPlan& task) {
    return task.release == Release::at_once ? TaskState::ready : TaskState::blocked;
}

/// Replaces invalid UTF-8, which a log line in a detail may contain.
std::string text_of(const json& document) {
    return document.dump(-1, ' ', false, json::error_handler_t::replace);
}

const std::string is_a_run = "SELECT 1 FROM runs WHERE id=?";

/// By the form of task ids (records/identity.hpp), without a query.
std::string run_of(const std::string& task) { return task.substr(0, task.find('-')); }

/// Replaces the task's artifacts.
void keep_artifacts(Connection& database, const std::string& task,
                    const std::vector<Artifact>& artifacts) {
    database.change("DELETE FROM artifacts WHERE task=?", {task});
    for (const Artifact& each : artifacts) {
        database.change(
            "INSERT OR REPLACE INTO artifacts (task, name, sha256, bytes) VALUES (?,?,?,?)",
            {each.task, each.name, each.sha256, each.bytes});
    }
}

}  // namespace

void Transaction::add_run(const NewRun& run) {
    const std::string now = utc_now();
    database_.change(
        R"(INSERT INTO runs (id, name, title, created, study, scene, warnings, sweep, last_task)
VALUES (?,?,?,?,?,?,?,?,?))",
        {run.id, run.name, run.title, now, run.study, run.scene,
         fault::as_json(run.warnings).dump(), std::int64_t{run.sweep ? 1 : 0},
         static_cast<std::int64_t>(run.tasks.size())});
    add_recipes(run.recipes);
    add_files(run);
    add_run_event(run.id, {{"event", "submit"}, {"tasks", run.tasks.size()}});
    for (std::size_t i = 0; i < run.tasks.size(); ++i) {
        const TaskPlan& task = run.tasks[i];
        std::optional<std::string> parent;
        if (task.parent) parent = task_id(run.id, *task.parent);
        insert_task(run.id, task_id(run.id, i), task, parent, run.priority, first_state(task));
    }
    add_triggers(run);
}

void Transaction::insert_task(const std::string& run, const std::string& id, const TaskPlan& task,
                              const std::optional<std::string>& parent, std::int64_t priority,
                              TaskState state) {
    database_.change(
        R"(INSERT INTO tasks (id, run, phase, label, transfer_time, parent, release, input, overrides,
    state, variant, priority, cores, memory_mb, recipe, ready_at)
VALUES (?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?))",
        {id, run, task.phase, task.label, value_or_null(task.transfer_time), value_or_null(parent),
         std::string(name_of(task.release)), task.input, json(task.overrides).dump(),
         std::string(name_of(state)), task.variant, priority, task.resources.cores,
         task.resources.memory_mb, task.recipe.empty() ? Value(nullptr) : Value(task.recipe),
         state == TaskState::ready ? Value(epoch_ms()) : Value(nullptr)});
}

/// From a counter rather than the number of tasks, so that no id is given twice.
std::int64_t Transaction::next_ordinal(const std::string& run) {
    return database_
        .integer("UPDATE runs SET last_task = last_task + 1 WHERE id=? RETURNING last_task - 1",
                 {run})
        .value_or(0);
}

/// Those of the run so far, and those that the extension adds or words anew: of more variants.
std::string Transaction::warnings_with(const std::string& run,
                                       const std::vector<fault::Flag>& more) const {
    std::vector<fault::Flag> all = fault::flags_in(
        json::parse(database_.text("SELECT warnings FROM runs WHERE id=?", {run}).value_or("[]")));
    std::erase_if(all, [&](const fault::Flag& old) {
        return std::ranges::any_of(more, [&](const fault::Flag& each) {
            return each.code == old.code && each.pointer == old.pointer;
        });
    });
    all.insert(all.end(), more.begin(), more.end());
    return fault::as_json(all).dump();
}

/// The extension was planned from an older snapshot; UNIQUE (run, label) refuses a task that came
/// in between. New tasks get the highest priority of the run's own.
void Transaction::extend_run(const std::string& run, const Extension& extension) {
    add_recipes(extension.recipes);
    database_.change("UPDATE runs SET study=?, warnings=?, sweep=1 WHERE id=?",
                     {extension.study.dump(), warnings_with(run, extension.warnings), run});
    add_run_event(run, {{"event", "extend"}, {"tasks", extension.tasks.size()}});
    const std::int64_t priority =
        // NULL for a run without tasks.
        database_.integer("SELECT max(priority) FROM tasks WHERE run=?", {run}).value_or(0);
    std::vector<std::string> ids;
    for (const AddedTask& each : extension.tasks) {
        auto parent = each.parent;
        if (each.plan.parent) parent = ids[*each.plan.parent];
        ids.push_back(task_id(run, static_cast<std::size_t>(next_ordinal(run))));
        insert_task(run, ids.back(), each.plan, parent, priority, first_state(each.plan));
        if (each.plan.phase == phases::fem.program)
            for (const TriggerPlan& trigger : extension.triggers)
                add_trigger(run, ids.back(), trigger);
    }
    if (!extension.samples.empty()) add_samples(run, extension);
}

void Transaction::add_recipes(const std::vector<Recipe>& recipes) {
    for (const Recipe& each : recipes) {
        database_.change(
            "INSERT OR IGNORE INTO recipes (hash, phase, cache_version, part) VALUES (?,?,?,?)",
            {each.hash, each.phase, each.cache_version, each.part});
    }
}

void Transaction::keep_idempotency_key(const std::string& key, const std::string& body_sha256,
                                       const std::string& run) {
    database_.change(
        "INSERT INTO idempotency_keys (key, body_sha256, run, created) VALUES (?,?,?,?)",
        {key, body_sha256, run, utc_now()});
}

TaskState Transaction::state_of(const std::string& task) const {
    const auto state = database_.text("SELECT state FROM tasks WHERE id=?", {task});
    if (!state) throw IllegalMove("no task " + task);
    return task_state_named(*state);
}

/// started keeps the first claim, so that a run's time includes retries. ready_at is the last
/// time it became ready, from which the wait is measured.
void Transaction::set_state(const std::string& task, TaskState from, TaskEvent event, TaskState to,
                            std::optional<std::int64_t> retry_at, json detail) {
    const std::string now = utc_now();
    database_.change(
        R"(UPDATE tasks SET state=?, retry_at=?,
    started=CASE WHEN ? THEN coalesce(started, ?) ELSE started END,
    ready_at=coalesce(?, ready_at), finished=? WHERE id=?)",
        {std::string(name_of(to)), value_or_null(retry_at),
         std::int64_t{event == TaskEvent::claim ? 1 : 0}, now,
         to == TaskState::ready ? Value(epoch_ms()) : Value(nullptr),
         is_final(to) ? Value(now) : Value(nullptr), task});
    if (event == TaskEvent::start)
        database_.change(
            "UPDATE attempts SET started=coalesce(started, ?) WHERE task=? AND finished IS NULL",
            {now, task});
    if (detail.is_null()) detail = json::object();
    detail["event"] = name_of(event);
    detail["from"] = name_of(from);
    detail["to"] = name_of(to);
    add_event(run_of(task), task, "task", detail);
}

/// Nothing: the table of lifecycle.cpp has no such move, because another thread was faster.
std::optional<TaskState> Transaction::try_move_task(const std::string& task, TaskEvent event,
                                                    json detail) {
    const TaskState from = state_of(task);
    const auto to = next(from, event);
    if (to) set_state(task, from, event, *to, std::nullopt, std::move(detail));
    return to;
}

TaskState Transaction::move_task(const std::string& task, TaskEvent event, json detail) {
    const auto to = try_move_task(task, event, std::move(detail));
    if (!to) {
        throw IllegalMove("task " + task + " is " + std::string(name_of(state_of(task))) +
                          ", event " + std::string(name_of(event)) + " is not allowed");
    }
    return *to;
}

void Transaction::move_task_to_retry(const std::string& task, TaskEvent event,
                                     std::int64_t retry_at, json detail) {
    const TaskState from = state_of(task);
    const auto to = next(from, event);
    if (to != TaskState::retry_wait) throw IllegalMove("task " + task + " cannot be retried");
    detail["retry_at"] = retry_at;
    set_state(task, from, event, *to, retry_at, std::move(detail));
}

/// The summary is kept for the life of the task; a retry clears it.
void Transaction::fail_task(const std::string& task, TaskEvent event, const TaskFault& fault) {
    json detail{{"summary", fault.summary}};
    if (fault.exit_code) detail["exit_code"] = *fault.exit_code;
    move_task(task, event, detail);
    database_.change("UPDATE tasks SET fault_exit=?, fault_summary=? WHERE id=?",
                     {value_or_null(fault.exit_code), fault.summary, task});
}

void Transaction::pass_over_task(const std::string& task, const std::string& why) {
    if (!next(state_of(task), TaskEvent::skip)) return;  // cancelled
    // Before the move: the SQL trigger that counts failures reads this column.
    database_.change("UPDATE tasks SET not_reached=1, fault_summary=? WHERE id=?", {why, task});
    move_task(task, TaskEvent::skip, {{"summary", why}, {"not_reached", true}});
}

void Transaction::finish_task(const std::string& task, const json& result,
                              const std::vector<Artifact>& artifacts,
                              const std::string& input_sha256) {
    keep_artifacts(database_, task, artifacts);
    database_.change("UPDATE tasks SET result=?, input_sha256=? WHERE id=?",
                     {text_of(result), input_sha256, task});
    move_task(task, TaskEvent::keep_outputs, {{"artifacts", artifacts.size()}});
}

/// Outputs of a failed or cancelled task are listed as well: logs and snapshots before a breakdown
/// are worth reading.
void Transaction::keep_remains(const std::string& task, const std::vector<Artifact>& artifacts,
                               const std::string& input_sha256) {
    const bool has_ended = database_.finds(
        "SELECT 1 FROM tasks WHERE id=? AND state IN ('failed', 'cancelled')", {task});
    if (!has_ended) return;  // retried, or its run was removed
    keep_artifacts(database_, task, artifacts);
    database_.change("UPDATE tasks SET input_sha256=? WHERE id=?", {input_sha256, task});
}

/// Called by Cache::take, with the files in place. False: `earlier` was removed or retried, or
/// the task is no longer ready; the cache then removes the files. same_as names the first of a
/// chain, which alone computed.
bool Transaction::reuse_task(const std::string& task, const Task& earlier) {
    const bool are_as_read = database_.finds(
        R"(SELECT 1 FROM tasks AS earlier JOIN tasks AS task ON task.id=?
WHERE earlier.id=? AND earlier.state=?)",
        {task, earlier.id, std::string(name_of(earlier.state))});
    if (!are_as_read) return false;
    const TaskEvent event =
        earlier.state == TaskState::failed ? TaskEvent::reuse_breakdown : TaskEvent::reuse;
    const std::string first = earlier.same_as.value_or(earlier.id);
    if (!try_move_task(task, event, {{"same_as", first}})) return false;
    database_.change(
        R"(INSERT OR REPLACE INTO artifacts (task, name, sha256, bytes)
SELECT ?, name, sha256, bytes FROM artifacts WHERE task=?)",
        {task, earlier.id});
    database_.change(
        R"(UPDATE tasks SET same_as=?3, (result, input_sha256, fault_exit, fault_summary)=
    (SELECT result, input_sha256, fault_exit, fault_summary FROM tasks WHERE id=?1) WHERE id=?2)",
        {earlier.id, task, first});
    return true;
}

void Transaction::note_cache_refusal(const std::string& task, const std::string& why) {
    database_.change("UPDATE tasks SET cache_refusal=? WHERE id=?", {why, task});
}

/// Before the process is started: after a kill, a row without a process is found and closed, never
/// a process without a row.
std::int64_t Transaction::add_attempt(const std::string& task) {
    const std::int64_t number =
        database_.integer("SELECT max(number) FROM attempts WHERE task=?", {task}).value_or(0) + 1;
    database_.change(
        "INSERT INTO attempts (task, number, state, created) VALUES (?,?,'submitting',?)",
        {task, number, utc_now()});
    add_event(run_of(task), task, "attempt", {{"number", number}, {"to", "submitting"}});
    return number;
}

void Transaction::move_attempt(const std::string& task, std::int64_t number, AttemptEvent event,
                               const AttemptEnd& end) {
    const auto from =
        database_.first("SELECT state FROM attempts WHERE task=? AND number=?", {task, number},
                        [](const Row& row) { return attempt_state_named(row.text("state")); });
    const auto to = from ? next(*from, event) : std::nullopt;
    if (!to) {
        throw IllegalMove("attempt " + attempt_id(task, number) + ": event " +
                          std::string(name_of(event)) + " is not allowed");
    }
    const std::string now = utc_now();
    const Value finished = is_live(*to) ? Value(nullptr) : Value(now);
    // For an attempt that began and ended between two looks.
    Value started(nullptr);
    if (end.wall_seconds)
        started = utc_text(epoch_ms() - static_cast<std::int64_t>(1000.0 * *end.wall_seconds));
    database_.change(
        R"(UPDATE attempts SET state=?, started=coalesce(started, ?), finished=?, exit_code=?, signal=?,
    wall_seconds=?, cpu_seconds=coalesce(?, cpu_seconds) WHERE task=? AND number=?)",
        {std::string(name_of(*to)), started, finished, value_or_null(end.exit_code),
         value_or_null(end.signal), value_or_null(end.wall_seconds), value_or_null(end.cpu_seconds),
         task, number});
    json detail{{"number", number},
                {"event", name_of(event)},
                {"from", name_of(*from)},
                {"to", name_of(*to)}};
    if (end.exit_code) detail["exit_code"] = *end.exit_code;
    if (end.signal) detail["signal"] = *end.signal;
    if (!end.reason.empty()) detail["stopped_for"] = end.reason;
    add_event(run_of(task), task, "attempt", detail);
}

/// Counts attempts that failed or were lost, not those that were interrupted; attempts count every
/// start.
std::int64_t Transaction::count_try(const std::string& task) {
    return database_
        .integer("UPDATE tasks SET tries = tries + 1 WHERE id=? RETURNING tries", {task})
        .value_or(0);
}

/// Triggers and batches first, so that nothing adds tasks to a run that is being cancelled.
/// Running tasks go to `cancelling`; the dispatcher ends their processes.
bool Transaction::cancel_run(const std::string& run, const std::string& why) {
    const std::vector<std::string> tasks =
        database_.texts("SELECT id FROM tasks WHERE run=? AND finished IS NULL", {run});
    const bool known = database_.finds(is_a_run, {run});
    disarm_triggers(run, why);
    end_batches(run, "stopped", why);
    for (const std::string& task : tasks) try_move_task(task, TaskEvent::cancel, {{"why", why}});
    if (!tasks.empty()) add_run_event(run, {{"event", "cancel"}, {"why", why}});
    return known;
}

bool Transaction::mark_run(const std::string& run, const char* column, std::int64_t value,
                           const char* event) {
    const std::string is(column);
    if (database_.change("UPDATE runs SET " + is + "=?1 WHERE id=?2 AND " + is + "<>?1",
                         {value, run}) > 0)
        add_run_event(run, {{"event", event}});
    return database_.finds(is_a_run, {run});
}

bool Transaction::pause_run(const std::string& run) { return mark_run(run, "paused", 1, "pause"); }
bool Transaction::resume_run(const std::string& run) {
    return mark_run(run, "paused", 0, "resume");
}

bool Transaction::rename_run(const std::string& run, const std::string& title) {
    const auto before = database_.text("SELECT title FROM runs WHERE id=?", {run});
    if (before && *before != title) {
        database_.change("UPDATE runs SET title=? WHERE id=?", {title, run});
        add_run_event(run, {{"event", "rename"}, {"from", *before}, {"title", title}});
    }
    return before.has_value();
}

/// Of all tasks, also ended ones: a retry starts with the new priority.
bool Transaction::set_priority(const std::string& run, std::int64_t priority) {
    const bool known =
        database_.change("UPDATE tasks SET priority=? WHERE run=?", {priority, run}) > 0;
    if (known) add_run_event(run, {{"event", "set_priority"}, {"priority", priority}});
    return known;
}

/// Ids are read first: moving tasks while the query steps over them would change what it returns.
/// not_reached tasks stay skipped, as the same FEM would end as early again.
std::optional<std::size_t> Transaction::retry_run(const std::string& run) {
    std::vector<std::string> tasks;
    std::set<std::string> ids;
    bool known = false;
    database_.query("SELECT id, state FROM tasks WHERE run=? AND not_reached=0 ORDER BY id", {run},
                    [&](const Row& row) {
                        known = true;
                        const TaskState state = task_state_named(row.text("state"));
                        const bool ended = next(state, TaskEvent::redo).has_value();
                        if (ended) tasks.push_back(row.text("id"));
                        if (ended || state == TaskState::cancelling) ids.insert(row.text("id"));
                    });
    if (!known) return std::nullopt;
    const std::vector<Trigger> triggers = triggers_to_rearm(run, ids);
    if (!ids.empty() || !triggers.empty())
        add_run_event(run,
                      {{"event", "retry"}, {"tasks", ids.size()}, {"triggers", triggers.size()}});
    for (const Trigger& each : triggers) move_trigger(each, TriggerEvent::rearm);
    open_batches(run, !ids.empty());
    for (const std::string& task : tasks) redo_task(task);
    return ids.size();
}

void Transaction::redo_task(const std::string& task) {
    // A retried breakdown loses its recipe: the cache would answer with the same breakdown.
    const auto release = database_.text(
        R"(UPDATE tasks SET tries=0, same_as=NULL, fault_exit=NULL, fault_summary=NULL,
    recipe=iif(fault_exit=70, NULL, recipe) WHERE id=? RETURNING release)",
        {task});
    database_.change("DELETE FROM artifacts WHERE task=?", {task});
    move_task(task, TaskEvent::redo);
    if (release == name_of(Release::at_once)) move_task(task, TaskEvent::release);
}

/// The last order to the run decides; it is stored as an event, so that it outlives the service.
bool Transaction::stop_task(const std::string& task) {
    if (!try_move_task(task, TaskEvent::stopped)) return false;
    const auto order = database_.text(
        R"(SELECT json_extract(detail, '$.event') AS word FROM events
    WHERE run=(SELECT run FROM tasks WHERE id=?) AND kind='run' AND word IN ('cancel', 'retry')
    ORDER BY seq DESC LIMIT 1)",
        {task});
    if (order == "retry") redo_task(task);
    return true;
}

void Transaction::add_event(const std::string& run, const std::optional<std::string>& task,
                            const std::string& kind, json detail) {
    // Only orders to a run have a requester; tasks are moved by the service.
    if (!by_.empty() && kind == "run") detail["by"] = by_;
    const std::string time = utc_now(), text = text_of(detail);
    database_.change("INSERT INTO events (time, run, task, kind, detail) VALUES (?,?,?,?,?)",
                     {time, run, value_or_null(task), kind, text});
    events_.push_back({.seq = database_.last_row_id(),
                       .time = time,
                       .run = run,
                       .task = task,
                       .kind = kind,
                       .detail = json::parse(text)});
}

}  // namespace breach::orchestrator
