// The reading half of the store.
#include <algorithm>

#include "core/phases/phases.hpp"
#include "services/findings/flags.hpp"
#include "services/orchestrator/records/identity.hpp"
#include "services/orchestrator/records/mean_columns.hpp"
#include "services/orchestrator/store/store.hpp"
#include "services/orchestrator/store/views.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

/// Every open state of a run or a sweep.
bool is_open_state(const std::string& state) {
    return state == "queued" || state == "running" || state == "budget_exhausted" ||
           state == "planning" || state == "refining";
}

/// A bisect refines as soon as its seeds are placed, samples as soon as more are drawn than at first.
std::string sweep_state() {
    return "CASE WHEN r.state NOT IN ('queued', 'running') THEN r.state WHEN NOT EXISTS (SELECT 1 "
           "FROM tasks AS t WHERE t.run=r.id AND " +
           makes_a_row("t") +
           ") THEN 'planning' WHEN EXISTS (SELECT 1 FROM triggers AS g WHERE g.run=r.id AND "
           "g.state IN ('armed', 'holding') AND (g.kind='bisect' AND (SELECT count(*) FROM firings "
           "WHERE firings.trigger=g.id) > json_extract(g.spec, '$.seeds') OR " +
           draws_samples("g.spec") +
           " AND (SELECT last_task FROM runs WHERE runs.id=r.id) > (SELECT "
           "json_extract(detail, '$.tasks') FROM events WHERE events.run=r.id AND "
           "json_extract(detail, '$.event')='submit' ORDER BY seq LIMIT 1))) THEN 'refining' ELSE "
           "r.state END";
}

std::string run_columns(const std::string& state = "r.state") {
    return "SELECT r.id, r.name, r.title, " + state +
           " AS shown, r.created, r.started, r.finished, r.tasks_total, "
           "r.tasks_done, r.tasks_ended, r.paused, r.tasks_failed, coalesce((SELECT t.label || ': "
           "' || "
           "t.fault_summary FROM tasks t INDEXED BY tasks_with_faults WHERE t.run "
           "= r.id AND "
           "t.fault_summary IS NOT NULL ORDER BY t.not_reached, t.id LIMIT 1), ''), "
           "r.questionable, "
           "r.pinned, r.budget_cpu_seconds, r.spent_cpu_seconds, (SELECT json_extract(e.detail, "
           "'$.by') "
           "FROM events e WHERE e.run = r.id ORDER BY e.seq LIMIT 1) FROM run_summaries r ";
}

Run run_from(const Row& row) {
    return {.id = row.text(0),
            .name = row.text(1),
            .title = row.text(2),
            .state = row.text(3),
            .created = row.text(4),
            .started = row.optional_text(5),
            .finished = row.optional_text(6),
            .tasks_total = row.integer(7),
            .tasks_done = row.integer(8),
            .tasks_ended = row.integer(9),
            .tasks_failed = row.integer(11),
            .message = row.text(12),
            .paused = row.integer(10) != 0,
            .questionable = row.integer(13),
            .pinned = row.integer(14) != 0,
            .budget = row.optional_real(15),
            .spent = row.real(16),
            .submitted_by = row.optional_text(17)};
}

constexpr const char* task_columns =
    "SELECT id, run, phase, label, transfer_time, state, parent, release, input, overrides, tries, "
    "started, "
    "finished, result, fault_exit, fault_summary, variant, cores, memory_mb, recipe, input_sha256, "
    "same_as, cache_refusal, priority, not_reached FROM tasks ";

Task task_from(const Row& row) {
    Task task{.id = row.text(0),
              .run = row.text(1),
              .phase = row.text(2),
              .label = row.text(3),
              .transfer_time = row.optional_real(4),
              .state = task_state_named(row.text(5)),
              .parent = row.optional_text(6),
              .release = release_named(row.text(7)),
              .input = row.text(8),
              .overrides = json::parse(row.text(9)).get<std::vector<std::string>>(),
              .tries = row.integer(10),
              .started = row.optional_text(11),
              .finished = row.optional_text(12),
              .result = std::nullopt,
              .fault = std::nullopt,
              .variant = row.text(16),
              .resources = {row.integer(17), row.integer(18)},
              .recipe = row.optional_text(19),
              .input_sha256 = row.optional_text(20),
              .same_as = row.optional_text(21),
              .cache_refusal = row.optional_text(22),
              .priority = row.integer(23),
              .not_reached = row.integer(24) != 0};
    if (!row.is_null(13)) task.result = json::parse(row.text(13));
    if (!row.is_null(15)) task.fault = TaskFault{row.optional_integer(14), row.text(15)};
    return task;
}

Value as_value(std::size_t count) { return static_cast<std::int64_t>(count); }
Value as_value(TaskState state) { return std::string(name_of(state)); }

}  // namespace

std::vector<Run> Store::runs(const RunFilter& filter, std::size_t most) const {
    std::string sql = run_columns(filter.sweeps_only ? sweep_state() : "r.state") + "WHERE 1";
    std::vector<Value> values;
    if (filter.state) {
        sql += " AND shown=?";
        values.emplace_back(*filter.state);
    }
    // The unfinished are few: found by their tasks, not by asking every run there ever was.
    if (filter.state && is_open_state(*filter.state))
        sql += " AND r.id IN (SELECT run FROM tasks WHERE finished IS NULL)";
    if (filter.name) {
        sql += " AND r.name=?";
        values.emplace_back(*filter.name);
    }
    if (filter.search) {
        sql += " AND instr(lower(r.name || char(10) || r.title || char(10) || r.id), lower(?)) > 0";
        values.emplace_back(*filter.search);
    }
    if (filter.before) {
        sql += " AND (r.created, r.id) < (?, ?)";
        values.emplace_back(filter.before->first);
        values.emplace_back(filter.before->second);
    }
    if (filter.sweeps_only) sql += " AND r.sweep=1";
    sql += " ORDER BY r.created DESC, r.id DESC LIMIT ?";
    values.push_back(as_value(most));
    std::vector<Run> found;
    read([&](Connection& database) {
        database.query(sql, values, [&](const Row& row) { found.push_back(run_from(row)); });
        gather_facts(database, found);
        tell_what_is_missing(database, found);
    });
    return found;
}

std::vector<Run> Store::runs(std::size_t most) const { return runs(RunFilter{}, most); }

std::vector<Run> Store::runs_that_may_go() const {
    std::vector<Run> found;
    read([&](Connection& database) {
        database.query(
            run_columns() + "WHERE r.finished IS NOT NULL AND r.pinned=0 ORDER BY r.finished, r.id",
            {}, [&](const Row& row) { found.push_back(run_from(row)); });
    });
    return found;
}

std::optional<IdempotentRun> Store::run_of_key(const std::string& key) const {
    std::optional<IdempotentRun> found;
    read([&](Connection& database) {
        database.query("SELECT body_sha256, run FROM idempotency_keys WHERE key=?", {key},
                       [&](const Row& row) {
                           found = IdempotentRun{row.text(0), row.text(1)};
                       });
    });
    return found;
}

std::optional<Run> Store::run(const std::string& id) const { return one_run(id, "r.state"); }

std::optional<Run> Store::sweep(const std::string& id) const { return one_run(id, sweep_state()); }

std::optional<Run> Store::one_run(const std::string& id, const std::string& state) const {
    std::vector<Run> found;
    read([&](Connection& database) {
        database.query(run_columns(state) + "WHERE r.id=?", {id},
                       [&](const Row& row) { found.push_back(run_from(row)); });
        gather_facts(database, found);
        tell_what_is_missing(database, found);
    });
    if (found.empty()) return std::nullopt;
    return std::move(found.front());
}

std::optional<json> Store::study_of(const std::string& run) const {
    std::optional<json> found;
    read([&](Connection& database) {
        database.query("SELECT study FROM runs WHERE id=?", {run},
                       [&](const Row& row) { found = json::parse(row.text(0)); });
    });
    return found;
}

std::optional<std::string> Store::scene_of(const std::string& run) const {
    std::optional<std::string> found;
    read([&](Connection& database) {
        database.query("SELECT scene FROM runs WHERE id=?", {run},
                       [&](const Row& row) { found = row.text(0); });
    });
    return found;
}

std::optional<Task> Store::task(const std::string& id) const {
    std::optional<Task> found;
    read([&](Connection& database) {
        database.query(std::string(task_columns) + "WHERE id=?", {id},
                       [&](const Row& row) { found = task_from(row); });
    });
    return found;
}

std::vector<Task> Store::tasks_of(const std::string& run) const {
    std::vector<Task> found;
    read([&](Connection& database) {
        database.query(std::string(task_columns) + "WHERE run=? ORDER BY id", {run},
                       [&](const Row& row) { found.push_back(task_from(row)); });
    });
    return found;
}

std::vector<Task> Store::tasks_of(const std::string& run, const std::string& after,
                                  std::size_t most) const {
    std::vector<Task> found;
    read([&](Connection& database) {
        // Ids begin with the run's, so that they are a range of the primary key.
        database.query(std::string(task_columns) + "WHERE id>? AND id<? ORDER BY id LIMIT ?",
                       {after.empty() ? run + "-" : after, run + ".", as_value(most)},
                       [&](const Row& row) { found.push_back(task_from(row)); });
    });
    return found;
}

std::optional<Task> Store::stability_of(const std::string& run, const std::string& variant) const {
    std::optional<Task> found;
    read([&](Connection& database) {
        database.query(std::string(task_columns) +
                           "WHERE run=? AND phase=? ORDER BY variant=? DESC, variant='' DESC, id "
                           "LIMIT 1",
                       {run, phases::lem.program, variant},
                       [&](const Row& row) { found = task_from(row); });
    });
    return found;
}

std::vector<Task> Store::computed_tasks_of(const std::string& run, std::size_t most) const {
    std::vector<Task> found;
    read([&](Connection& database) {
        database.query(
            std::string(task_columns) +
                "WHERE id IN (SELECT id FROM (SELECT id, row_number() OVER places AS place, "
                "count(*) OVER (PARTITION BY phase) AS n FROM tasks WHERE run=?1 AND "
                "state='succeeded' WINDOW places AS (PARTITION BY phase ORDER BY transfer_time, "
                "variant, id)) WHERE place * ?2 / n > (place - 1) * ?2 / n) ORDER BY id",
            {run, as_value(most)}, [&](const Row& row) { found.push_back(task_from(row)); });
    });
    return found;
}

std::vector<Task> Store::tasks_in(TaskState state, std::size_t most) const {
    std::vector<Task> found;
    read([&](Connection& database) {
        database.query(std::string(task_columns) + "WHERE state=? ORDER BY id LIMIT ?",
                       {as_value(state), as_value(most)},
                       [&](const Row& row) { found.push_back(task_from(row)); });
    });
    return found;
}

std::vector<Task> Store::tasks_to_start(const std::vector<std::string>& full_queues,
                                        std::size_t most) const {
    std::vector<Task> found;
    read([&](Connection& database) {
        database.query(std::string(task_columns) +
                           "INDEXED BY tasks_to_start WHERE state='ready' AND phase NOT IN (SELECT "
                           "value FROM json_each(?)) AND run NOT IN (SELECT id FROM runs WHERE "
                           "paused=1 UNION ALL SELECT id FROM runs JOIN spendings ON "
                           "spendings.run=id WHERE spendings.cpu_seconds>=budget_cpu_seconds) "
                           "ORDER BY priority DESC, id LIMIT ?",
                       {json(full_queues).dump(), as_value(most)},
                       [&](const Row& row) { found.push_back(task_from(row)); });
    });
    return found;
}

std::vector<BlockedTask> Store::blocked_children(const std::string& parent) const {
    std::vector<BlockedTask> found;
    read([&](Connection& database) {
        database.query(
            "SELECT id, release, input, transfer_time FROM tasks WHERE parent=? AND "
            "state='blocked' ORDER BY id",
            {parent}, [&](const Row& row) {
                found.push_back(
                    {row.text(0), release_named(row.text(1)), row.text(2), row.optional_real(3)});
            });
    });
    return found;
}

std::vector<std::string> Store::parents_of_blocked() const {
    std::vector<std::string> found;
    read([&](Connection& database) {
        database.query("SELECT DISTINCT parent FROM tasks WHERE state='blocked'", {},
                       [&](const Row& row) { found.push_back(row.text(0)); });
    });
    return found;
}

std::optional<std::int64_t> Store::ready_at(const std::string& task) const {
    std::optional<std::int64_t> found;
    read([&](Connection& database) {
        database.query("SELECT ready_at FROM tasks WHERE id=?", {task},
                       [&](const Row& row) { found = row.optional_integer(0); });
    });
    return found;
}

std::vector<std::string> Store::due_retries(std::int64_t now) const {
    std::vector<std::string> found;
    read([&](Connection& database) {
        // One that is due later than any delay was set before the clock was: it has waited enough.
        database.query(
            "SELECT id FROM tasks WHERE state='retry_wait' AND (retry_at<=?1 OR "
            "retry_at>?1+?2)",
            {now, longest_retry_ms}, [&](const Row& row) { found.push_back(row.text(0)); });
    });
    return found;
}

std::optional<std::int64_t> Store::next_retry() const {
    std::optional<std::int64_t> found;
    read([&](Connection& database) {
        database.query("SELECT min(retry_at) FROM tasks WHERE state='retry_wait'", {},
                       [&](const Row& row) { found = row.optional_integer(0); });
    });
    return found;
}

namespace {

constexpr const char* attempt_columns =
    "SELECT task, number, state, created, started, finished, exit_code, signal, wall_seconds, "
    "cpu_seconds FROM attempts ";

Attempt attempt_from(const Row& row) {
    return {.task = row.text(0),
            .number = row.integer(1),
            .state = attempt_state_named(row.text(2)),
            .created = row.text(3),
            .started = row.optional_text(4),
            .finished = row.optional_text(5),
            .exit_code = row.optional_integer(6),
            .signal = row.optional_integer(7),
            .wall_seconds = row.optional_real(8),
            .cpu_seconds = row.optional_real(9)};
}

Artifact artifact_from(const Row& row) {
    return {row.text(0), row.text(1), row.text(2), row.integer(3)};
}

}  // namespace

std::vector<Attempt> Store::attempts_of(const std::string& task) const {
    std::vector<Attempt> found;
    read([&](Connection& database) {
        database.query(std::string(attempt_columns) + "WHERE task=? ORDER BY number", {task},
                       [&](const Row& row) { found.push_back(attempt_from(row)); });
    });
    return found;
}

std::map<std::string, std::vector<Attempt>> Store::attempts_between(const std::string& first,
                                                                    const std::string& last) const {
    std::map<std::string, std::vector<Attempt>> found;
    read([&](Connection& database) {
        database.query(
            std::string(attempt_columns) + "WHERE task>=? AND task<=? ORDER BY task, number",
            {first, last},
            [&](const Row& row) { found[row.text(0)].push_back(attempt_from(row)); });
    });
    return found;
}

std::vector<Artifact> Store::artifacts_of(const std::string& task) const {
    std::vector<Artifact> found;
    read([&](Connection& database) {
        database.query("SELECT task, name, sha256, bytes FROM artifacts WHERE task=? ORDER BY name",
                       {task}, [&](const Row& row) { found.push_back(artifact_from(row)); });
    });
    return found;
}

std::map<std::string, std::vector<Artifact>> Store::artifacts_between(
    const std::string& first, const std::string& last) const {
    std::map<std::string, std::vector<Artifact>> found;
    read([&](Connection& database) {
        database.query(
            "SELECT task, name, sha256, bytes FROM artifacts WHERE task>=? AND task<=? ORDER BY "
            "task, name",
            {first, last},
            [&](const Row& row) { found[row.text(0)].push_back(artifact_from(row)); });
    });
    return found;
}

std::optional<Artifact> Store::artifact(const std::string& sha256) const {
    std::optional<Artifact> found;
    read([&](Connection& database) {
        database.query("SELECT task, name, sha256, bytes FROM artifacts WHERE sha256=? LIMIT 1",
                       {sha256}, [&](const Row& row) {
                           found = Artifact{row.text(0), row.text(1), row.text(2), row.integer(3)};
                       });
    });
    return found;
}

std::optional<Artifact> Store::maker_of(const std::string& sha256) const {
    std::optional<Artifact> found;
    read([&](Connection& database) {
        database.query(
            "SELECT task, name, sha256, bytes FROM artifacts JOIN tasks ON tasks.id=task WHERE "
            "sha256=? ORDER BY same_as IS NOT NULL, state='cached', task LIMIT 1",
            {sha256}, [&](const Row& row) { found = artifact_from(row); });
    });
    return found;
}

std::map<std::string, FactorsOfSafety> Store::factors_of_safety(const std::string& run) const {
    std::map<std::string, FactorsOfSafety> found;
    read([&](Connection& database) {
        database.query("SELECT variant, json_extract(result, '$.factor_of_safety'), " +
                           factor_liquefied("result") +
                           " FROM tasks WHERE run=? AND phase=? AND result IS NOT NULL",
                       {run, phases::lem.program}, [&](const Row& row) {
                           found[row.text(0)] = {row.optional_real(1), row.optional_real(2)};
                       });
    });
    return found;
}

std::vector<AccuracyRung> Store::accuracy_rungs(std::size_t most_runs) const {
    std::vector<AccuracyRung> found;
    read([&](Connection& database) {
        // The condition on the study as the index runs_with_accuracy has it.
        database.query(
            "SELECT run, variant, id, recipe FROM tasks WHERE run IN (SELECT id FROM runs WHERE "
            "json_type(study, '$.accuracy')='object' ORDER BY id DESC LIMIT ?) AND phase=? AND "
            "recipe IS NOT NULL ORDER BY run DESC, id",
            {as_value(most_runs), phases::mpm.program}, [&](const Row& row) {
                found.push_back({.run = row.text(0),
                                 .variant = row.text(1),
                                 .mpm_task = row.text(2),
                                 .recipe = row.text(3)});
            });
    });
    return found;
}

std::pair<std::int64_t, std::int64_t> Store::points_of(const std::string& run) const {
    std::pair<std::int64_t, std::int64_t> counts{0, 0};
    read([&](Connection& database) {
        database.query(
            "SELECT count(*), coalesce(sum(state IN ('succeeded', 'cached')), 0) FROM tasks WHERE "
            "run=? AND " +
                makes_a_row("tasks"),
            {run}, [&](const Row& row) {
                counts = {row.integer(0), row.integer(1)};
            });
    });
    return counts;
}

namespace {

json value_from(const Row& row, int column, ColumnKind kind) {
    if (row.is_null(column)) return nullptr;
    switch (kind) {
        case ColumnKind::number:
            return row.real(column);
        case ColumnKind::yes_no:
            return row.integer(column) != 0;
        case ColumnKind::word:
            return row.text(column);
        case ColumnKind::flags:
            return json::parse(row.text(column));
    }
    return nullptr;
}

ResultRow result_from(const Row& row, std::span<const ResultColumn> columns) {
    ResultRow values;
    for (const ResultColumn& each : columns)
        values.push_back(value_from(row, static_cast<int>(values.size()), each.kind));
    return values;
}

}  // namespace

std::vector<ResultRow> Store::results(const std::string& run, const ResultFilter& filter) const {
    std::string sql = "SELECT " + selected_result_columns() + " FROM sweep_results WHERE ";
    std::vector<Value> values{run, as_value(filter.most), as_value(filter.from)};
    if (filter.takes_all()) {
        sql += "run=?1 ORDER BY variant_place, transfer_time";
        values = {run};
    } else if (!filter.state && !filter.flag) {
        // The page is found first, so that a long table is not worked out for a part of it.
        sql +=
            "mpm_task IN (SELECT tasks.id FROM tasks LEFT JOIN variants ON "
            "variants.run=tasks.run AND variants.name=tasks.variant WHERE tasks.run=?1 AND " +
            makes_a_row("tasks") +
            " ORDER BY coalesce(variants.place, 0), tasks.transfer_time "
            "LIMIT ?2 OFFSET ?3) ORDER BY variant_place, transfer_time";
    } else {
        sql +=
            "run=?1 AND (?4 IS NULL OR state=?4) AND (?5 IS NULL OR instr(';' || flags || ';', "
            "';' || ?5 || ';') > 0) ORDER BY variant_place, transfer_time LIMIT ?2 OFFSET ?3";
        values.push_back(value_or_null(filter.state));
        values.push_back(value_or_null(filter.flag));
    }
    std::vector<ResultRow> found;
    read([&](Connection& database) {
        database.query(sql, values, [&](const Row& row) {
            found.push_back(result_from(row, result_columns()));
        });
    });
    for (ResultRow& each : found)
        if (!value_of(each, "runout").is_null())
            value_of(each, "lower_bound") =
                findings::still_moves(value_of(each, "at_rest"), value_of(each, "flags"));
    return found;
}

std::vector<ResultRow> Store::means(const std::string& run) const {
    std::vector<ResultRow> found;
    read([&](Connection& database) {
        bool drawn = false;
        database.query("SELECT 1 FROM variants WHERE run=? AND draw_of IS NOT NULL LIMIT 1", {run},
                       [&](const Row&) { drawn = true; });
        if (!drawn) return;
        database.query("SELECT " + selected_mean_columns() + " FROM (" +
                           selected_means("AND run=?") + ") ORDER BY variant_place, transfer_time",
                       {run},
                       [&](const Row& row) { found.push_back(result_from(row, mean_columns())); });
    });
    return found;
}

namespace {

Event event_from(const Row& row) {
    return {.seq = row.integer(0),
            .time = row.text(1),
            .run = row.text(2),
            .task = row.optional_text(3),
            .kind = row.text(4),
            .detail = json::parse(row.text(5))};
}

}  // namespace

std::vector<Event> Store::events_after(std::int64_t seq, std::size_t most) const {
    {
        const std::lock_guard lock(events_mutex_);
        if (auto recent = recent_events_.after(seq, most)) return *std::move(recent);
    }
    std::vector<Event> found;
    read([&](Connection& database) {
        database.query(
            "SELECT seq, time, run, task, kind, detail FROM events WHERE seq>? ORDER BY seq LIMIT "
            "?",
            {seq, as_value(most)}, [&](const Row& row) { found.push_back(event_from(row)); });
    });
    return found;
}

std::vector<Event> Store::events_of_run(const std::string& run, std::int64_t after,
                                        std::size_t most) const {
    std::vector<Event> found;
    read([&](Connection& database) {
        database.query(
            "SELECT seq, time, run, task, kind, detail FROM events WHERE run=? AND seq>? ORDER BY "
            "seq LIMIT ?",
            {run, after, as_value(most)},
            [&](const Row& row) { found.push_back(event_from(row)); });
    });
    return found;
}

}  // namespace breach::orchestrator
