#include "services/orchestrator/store/transaction.hpp"

#include "services/orchestrator/identity.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

std::string_view name_of(Release release) {
    switch (release) {
        case Release::at_once:
            return "at_once";
        case Release::file_exists:
            return "file_exists";
        case Release::parent_succeeded:
            break;
    }
    return "parent_succeeded";
}

/// A log line in a detail may hold bytes that are not UTF-8.
std::string text_of(const json& document) {
    return document.dump(-1, ' ', false, json::error_handler_t::replace);
}

std::string run_of(const std::string& task) { return task.substr(0, task.find('-')); }

}  // namespace

void Transaction::add_run(const NewRun& run) {
    const std::string now = utc_now();
    database_.change(
        "INSERT INTO runs (id, name, title, created, study, scene) VALUES (?,?,?,?,?,?)",
        {run.id, run.name, run.title, now, run.study, run.scene});
    add_event(run.id, std::nullopt, "run", {{"event", "submit"}, {"tasks", run.tasks.size()}});
    for (std::size_t i = 0; i < run.tasks.size(); ++i) {
        const TaskPlan& task = run.tasks[i];
        const TaskState state =
            task.release == Release::at_once ? TaskState::ready : TaskState::blocked;
        Value parent = nullptr;
        if (task.parent) parent = task_id(run.id, *task.parent);
        database_.change(
            "INSERT INTO tasks (id, run, phase, label, transfer_time, parent, release, input, "
            "overrides, "
            "state) VALUES (?,?,?,?,?,?,?,?,?,?)",
            {task_id(run.id, i), run.id, task.phase, task.label, value_or_null(task.transfer_time),
             parent, std::string(name_of(task.release)), task.input, json(task.overrides).dump(),
             std::string(orchestrator::name_of(state))});
    }
}

TaskState Transaction::state_of(const std::string& task) const {
    std::optional<TaskState> state;
    database_.query("SELECT state FROM tasks WHERE id=?", {task},
                    [&](const Row& row) { state = task_state_named(row.text(0)); });
    if (!state) throw IllegalMove("no task " + task);
    return *state;
}

void Transaction::set_state(const std::string& task, TaskState from, TaskEvent event, TaskState to,
                            std::optional<std::int64_t> retry_at, json detail) {
    const std::string now = utc_now();
    database_.change(
        "UPDATE tasks SET state=?, retry_at=?, started=CASE WHEN ? THEN coalesce(started, ?) ELSE "
        "started "
        "END, finished=? WHERE id=?",
        {std::string(orchestrator::name_of(to)), value_or_null(retry_at),
         std::int64_t{event == TaskEvent::claim ? 1 : 0}, now,
         is_final(to) ? Value(now) : Value(nullptr), task});
    if (detail.is_null()) detail = json::object();
    detail["event"] = orchestrator::name_of(event);
    detail["from"] = orchestrator::name_of(from);
    detail["to"] = orchestrator::name_of(to);
    add_event(run_of(task), task, "task", detail);
}

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
        throw IllegalMove("task " + task + " is " +
                          std::string(orchestrator::name_of(state_of(task))) + ", event " +
                          std::string(orchestrator::name_of(event)) + " is not allowed");
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

void Transaction::fail_task(const std::string& task, TaskEvent event, const TaskFault& fault) {
    json detail{{"summary", fault.summary}};
    if (fault.exit_code) detail["exit_code"] = *fault.exit_code;
    move_task(task, event, detail);
    database_.change("UPDATE tasks SET fault_exit=?, fault_summary=? WHERE id=?",
                     {value_or_null(fault.exit_code), fault.summary, task});
}

void Transaction::finish_task(const std::string& task, const json& result,
                              const std::vector<Artifact>& artifacts) {
    for (const Artifact& each : artifacts) {
        database_.change(
            "INSERT OR REPLACE INTO artifacts (task, name, sha256, bytes) VALUES (?,?,?,?)",
            {each.task, each.name, each.sha256, each.bytes});
    }
    database_.change("UPDATE tasks SET result=? WHERE id=?", {text_of(result), task});
    move_task(task, TaskEvent::keep_outputs, {{"artifacts", artifacts.size()}});
}

std::int64_t Transaction::add_attempt(const std::string& task) {
    std::int64_t number = 1;
    database_.query("SELECT coalesce(max(number), 0) + 1 FROM attempts WHERE task=?", {task},
                    [&](const Row& row) { number = row.integer(0); });
    database_.change(
        "INSERT INTO attempts (task, number, state, created) VALUES (?,?,'submitting',?)",
        {task, number, utc_now()});
    add_event(run_of(task), task, "attempt", {{"number", number}, {"to", "submitting"}});
    return number;
}

void Transaction::move_attempt(const std::string& task, std::int64_t number, AttemptEvent event,
                               const AttemptEnd& end) {
    std::optional<AttemptState> from;
    database_.query("SELECT state FROM attempts WHERE task=? AND number=?", {task, number},
                    [&](const Row& row) { from = attempt_state_named(row.text(0)); });
    const auto to = from ? next(*from, event) : std::nullopt;
    if (!to) {
        throw IllegalMove("attempt " + attempt_id(task, number) + ": event " +
                          std::string(orchestrator::name_of(event)) + " is not allowed");
    }
    const std::string now = utc_now();
    const Value started = event == AttemptEvent::submit ? Value(now) : Value(nullptr);
    const Value finished = is_live(*to) ? Value(nullptr) : Value(now);
    database_.change(
        "UPDATE attempts SET state=?, started=coalesce(started, ?), finished=?, exit_code=?, "
        "signal=?, "
        "wall_seconds=?, cpu_seconds=? WHERE task=? AND number=?",
        {std::string(orchestrator::name_of(*to)), started, finished, value_or_null(end.exit_code),
         value_or_null(end.signal), value_or_null(end.wall_seconds), value_or_null(end.cpu_seconds),
         task, number});
    json detail{{"number", number},
                {"event", orchestrator::name_of(event)},
                {"from", orchestrator::name_of(*from)},
                {"to", orchestrator::name_of(*to)}};
    if (end.exit_code) detail["exit_code"] = *end.exit_code;
    if (end.signal) detail["signal"] = *end.signal;
    if (!end.reason.empty()) detail["stopped_for"] = end.reason;
    add_event(run_of(task), task, "attempt", detail);
}

std::int64_t Transaction::count_try(const std::string& task) {
    std::int64_t tries = 0;
    database_.query("UPDATE tasks SET tries = tries + 1 WHERE id=? RETURNING tries", {task},
                    [&](const Row& row) { tries = row.integer(0); });
    return tries;
}

bool Transaction::cancel_run(const std::string& run, const std::string& why) {
    std::vector<std::string> tasks;
    database_.query("SELECT id FROM tasks WHERE run=? AND finished IS NULL", {run},
                    [&](const Row& row) { tasks.push_back(row.text(0)); });
    bool known = !tasks.empty();
    if (!known)
        database_.query("SELECT 1 FROM runs WHERE id=?", {run}, [&](const Row&) { known = true; });
    for (const std::string& task : tasks) try_move_task(task, TaskEvent::cancel, {{"why", why}});
    if (!tasks.empty()) add_event(run, std::nullopt, "run", {{"event", "cancel"}, {"why", why}});
    return known;
}

void Transaction::add_event(const std::string& run, const std::optional<std::string>& task,
                            const std::string& kind, const json& detail) {
    database_.change("INSERT INTO events (time, run, task, kind, detail) VALUES (?,?,?,?,?)",
                     {utc_now(), run, value_or_null(task), kind, text_of(detail)});
    last_event_ = database_.last_row_id();
}

}  // namespace breach::orchestrator
