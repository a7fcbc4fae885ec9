// The read operations of the store.
#include <algorithm>
#include <map>

#include "core/phases/phases.hpp"
#include "services/findings/flags.hpp"
#include "services/orchestrator/records/identity.hpp"
#include "services/orchestrator/records/mean_columns.hpp"
#include "services/orchestrator/store/store.hpp"
#include "services/orchestrator/store/views.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

/// The index tasks_unfinished finds these runs. It misses the moment in which all tasks have
/// ended and only a trigger or a batch is open.
bool is_open_state(const std::string& state) {
    return state == "queued" || state == "running" || state == "planning" || state == "refining";
}

/// Bisections refine once their seeds are placed, uncertainty studies once samples are added.
std::string sweep_state() {
    return R"(CASE WHEN r.state NOT IN ('queued', 'running') THEN r.state
    WHEN NOT EXISTS (SELECT 1 FROM tasks AS t WHERE t.run=r.id AND )" +
           makes_a_row("t") + R"() THEN 'planning'
    WHEN EXISTS (SELECT 1 FROM triggers AS g WHERE g.run=r.id AND g.state IN ('armed', 'holding')
        AND g.kind='bisect' AND json_extract(g.spec, '$.seeds') <
            (SELECT count(*) FROM firings WHERE firings.trigger=g.id))
        OR EXISTS (SELECT 1 FROM batches AS b WHERE b.run=r.id AND b.state='open'
            AND (SELECT last_task FROM runs WHERE runs.id=r.id)
                > (SELECT json_extract(detail, '$.tasks') FROM events WHERE events.run=r.id
                   AND json_extract(detail, '$.event')='submit' ORDER BY seq LIMIT 1))
        THEN 'refining' ELSE r.state END)";
}

/// run_summaries derives the state from counts. message is the first fault in order of id, a real
/// fault before a time that was not reached. submitted_by comes from the first event.
std::string selected_runs(const std::string& state = "r.state") {
    return "SELECT " + state +
           R"( AS shown, r.id, r.name, r.title, r.created, r.started, r.finished,
    r.tasks_total, r.tasks_done, r.tasks_ended, r.tasks_failed, r.paused, r.questionable, r.warnings,
    coalesce((SELECT t.label || ': ' || t.fault_summary FROM tasks t INDEXED BY tasks_with_faults
        WHERE t.run = r.id AND t.fault_summary IS NOT NULL ORDER BY t.not_reached, t.id LIMIT 1), '')
        AS message,
    (SELECT json_extract(e.detail, '$.by') FROM events e WHERE e.run = r.id ORDER BY e.seq LIMIT 1)
        AS submitted_by
FROM run_summaries r )";
}

/// The verdict's facts and the governing result are added for a whole page (gather_facts).
Run run_from(const Row& row) {
    return {.id = row.text("id"),
            .name = row.text("name"),
            .title = row.text("title"),
            .state = row.text("shown"),
            .created = row.text("created"),
            .started = row.optional_text("started"),
            .finished = row.optional_text("finished"),
            .tasks_total = row.integer("tasks_total"),
            .tasks_done = row.integer("tasks_done"),
            .tasks_ended = row.integer("tasks_ended"),
            .tasks_failed = row.integer("tasks_failed"),
            .message = row.text("message"),
            .paused = row.yes("paused"),
            .questionable = row.integer("questionable"),
            .submitted_by = row.optional_text("submitted_by"),
            .facts = {.state = row.text("shown"),
                      .submitted = fault::flags_in(row.document("warnings"))}};
}

const std::string selected_tasks =
    R"(SELECT id, run, phase, label, transfer_time, state, parent, release, input, overrides, tries,
    started, finished, result, fault_exit, fault_summary, variant, cores, memory_mb, recipe,
    input_sha256, same_as, cache_refusal, priority, not_reached FROM tasks )";

Task task_from(const Row& row) {
    Task task{.id = row.text("id"),
              .run = row.text("run"),
              .phase = row.text("phase"),
              .label = row.text("label"),
              .transfer_time = row.optional_real("transfer_time"),
              .state = task_state_named(row.text("state")),
              .parent = row.optional_text("parent"),
              .release = release_named(row.text("release")),
              .input = row.text("input"),
              .overrides = row.document("overrides").get<std::vector<std::string>>(),
              .tries = row.integer("tries"),
              .started = row.optional_text("started"),
              .finished = row.optional_text("finished"),
              .result = row.optional_document("result"),
              .fault = std::nullopt,
              .variant = row.text("variant"),
              .resources = {row.integer("cores"), row.integer("memory_mb")},
              .recipe = row.optional_text("recipe"),
              .input_sha256 = row.optional_text("input_sha256"),
              .same_as = row.optional_text("same_as"),
              .cache_refusal = row.optional_text("cache_refusal"),
              .priority = row.integer("priority"),
              .not_reached = row.yes("not_reached")};
    if (const auto summary = row.optional_text("fault_summary"))
        task.fault = TaskFault{row.optional_integer("fault_exit"), *summary};
    return task;
}

Value as_value(std::size_t count) { return static_cast<std::int64_t>(count); }
Value as_value(TaskState state) { return std::string(name_of(state)); }

}  // namespace

std::vector<Run> Store::runs(const RunFilter& filter, std::size_t most) const {
    std::string sql = selected_runs(filter.sweeps_only ? sweep_state() : "r.state") + "WHERE 1";
    std::vector<Value> values;
    if (filter.state) {
        sql += " AND shown=?";
        values.emplace_back(*filter.state);
    }
    // Open runs are few: start from what keeps them open (views.cpp) instead of all runs.
    if (filter.state && is_open_state(*filter.state))
        sql += R"( AND r.id IN (SELECT run FROM tasks WHERE finished IS NULL
    UNION SELECT run FROM triggers WHERE state IN ('armed', 'holding')
    UNION SELECT run FROM batches WHERE state='open'))";
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
    return whole_runs(sql, values);
}

std::vector<Run> Store::runs(std::size_t most) const { return runs(RunFilter{}, most); }

std::vector<Run> Store::whole_runs(const std::string& sql, const std::vector<Value>& values) const {
    const Reader database = reader();
    std::vector<Run> found = database->select(sql, values, run_from);
    gather_facts(*database, found);
    return found;
}

/// Oldest end first: Retention removes from the front.
std::vector<Run> Store::runs_that_may_go() const {
    return reader()->select(selected_runs() + R"(WHERE r.finished IS NOT NULL
ORDER BY r.finished, r.id)",
                            {}, run_from);
}

std::optional<IdempotentRun> Store::run_of_key(const std::string& key) const {
    return reader()->first("SELECT body_sha256, run FROM idempotency_keys WHERE key=?", {key},
                           [](const Row& row) {
                               return IdempotentRun{row.text("body_sha256"), row.text("run")};
                           });
}

std::optional<Run> Store::run(const std::string& id) const { return one_run(id, "r.state"); }

std::optional<Run> Store::sweep(const std::string& id) const { return one_run(id, sweep_state()); }

std::optional<Run> Store::one_run(const std::string& id, const std::string& state) const {
    std::vector<Run> found = whole_runs(selected_runs(state) + "WHERE r.id=?", {id});
    if (found.empty()) return std::nullopt;
    return std::move(found.front());
}

/// Attempts overlap: each counts only from the latest end before it (window `before`), so that
/// the sum is the time with at least one process. finished NULL: it still runs.
std::pair<double, double> Store::computing_and_idle(const Run& run) const {
    const auto found = reader()->first(
        R"(WITH spans AS (SELECT julianday(attempts.started) AS begin,
        julianday(coalesce(attempts.finished, 'now')) AS end
    FROM attempts JOIN tasks ON tasks.id=task WHERE run=?1 AND attempts.started IS NOT NULL),
before AS (SELECT begin, end, max(end) OVER (ORDER BY begin, end
        ROWS BETWEEN UNBOUNDED PRECEDING AND 1 PRECEDING) AS last FROM spans)
SELECT 86400.0 * coalesce(sum(max(0.0, end - max(begin, coalesce(last, begin)))), 0.0) AS computing,
    86400.0 * (julianday(coalesce(?3, 'now')) - julianday(?2)) AS since FROM before)",
        {run.id, run.created, value_or_null(run.finished)},
        [](const Row& row) { return std::pair(row.real("computing"), row.real("since")); });
    return {found->first, std::max(0.0, found->second - found->first)};
}

std::optional<json> Store::study_of(const std::string& run) const {
    return reader()->first("SELECT study FROM runs WHERE id=?", {run},
                           [](const Row& row) { return row.document("study"); });
}

std::optional<std::string> Store::scene_of(const std::string& run) const {
    return reader()->text("SELECT scene FROM runs WHERE id=?", {run});
}

std::optional<Task> Store::task(const std::string& id) const {
    return reader()->first(selected_tasks + "WHERE id=?", {id}, task_from);
}

std::vector<Task> Store::tasks_of(const std::string& run) const {
    return reader()->select(selected_tasks + "WHERE run=? ORDER BY id", {run}, task_from);
}

std::vector<Task> Store::tasks_of(const std::string& run, const std::string& after,
                                  std::size_t most) const {
    // Ids of tasks begin with the run's id: a range of the primary key.
    return reader()->select(selected_tasks + "WHERE id>? AND id<? ORDER BY id LIMIT ?",
                            {after.empty() ? run + "-" : after, run + ".", as_value(most)},
                            task_from);
}

/// The variant's own, else the one for all (variant ''), else any: for triggers and their FEM.
std::optional<Task> Store::stability_of(const std::string& run, const std::string& variant,
                                        const std::string& phase) const {
    return reader()->first(
        selected_tasks +
            "WHERE run=? AND phase=? ORDER BY variant=? DESC, variant='' DESC, id LIMIT 1",
        {run, phase, variant}, task_from);
}

/// An even choice of at most ?2 tasks of each phase, over its transfer times and variants: place
/// * most / n steps up at each chosen one.
std::vector<Task> Store::computed_tasks_of(const std::string& run, std::size_t most) const {
    return reader()->select(selected_tasks + R"(WHERE id IN (SELECT id
    FROM (SELECT id, row_number() OVER places AS place, count(*) OVER (PARTITION BY phase) AS n
          FROM tasks WHERE run=?1 AND state='succeeded'
          WINDOW places AS (PARTITION BY phase ORDER BY transfer_time, variant, id))
    WHERE place * ?2 / n > (place - 1) * ?2 / n) ORDER BY id)",
                            {run, as_value(most)}, task_from);
}

std::vector<Task> Store::tasks_in(TaskState state, std::size_t most) const {
    return reader()->select(selected_tasks + "WHERE state=? ORDER BY id LIMIT ?",
                            {as_value(state), as_value(most)}, task_from);
}

/// In order of priority, then age. full_queues are phases at their limit: without them here, a
/// thousand of them would hide all others behind the LIMIT.
std::vector<Task> Store::tasks_to_start(const std::vector<std::string>& full_queues,
                                        std::size_t most) const {
    return reader()->select(selected_tasks + R"(INDEXED BY tasks_to_start WHERE state='ready'
    AND phase NOT IN (SELECT value FROM json_each(?))
    AND run NOT IN (SELECT id FROM runs WHERE paused=1)
ORDER BY priority DESC, id LIMIT ?)",
                            {json(full_queues).dump(), as_value(most)}, task_from);
}

/// When the parent has written a file or has ended: what waits for it.
std::vector<BlockedTask> Store::blocked_children(const std::string& parent) const {
    return reader()->select(
        R"(SELECT id, release, input, transfer_time FROM tasks WHERE parent=? AND state='blocked'
ORDER BY id)",
        {parent}, [](const Row& row) {
            return BlockedTask{row.text("id"), release_named(row.text("release")),
                               row.text("input"), row.optional_real("transfer_time")};
        });
}

std::vector<std::string> Store::parents_of_blocked() const {
    return reader()->texts("SELECT DISTINCT parent FROM tasks WHERE state='blocked'");
}

std::optional<std::int64_t> Store::ready_at(const std::string& task) const {
    return reader()->integer("SELECT ready_at FROM tasks WHERE id=?", {task});
}

std::vector<std::string> Store::due_retries(std::int64_t now) const {
    // A retry later than any delay was set before the clock was changed: it is due.
    return reader()->texts(
        "SELECT id FROM tasks WHERE state='retry_wait' AND (retry_at<=?1 OR retry_at>?1+?2)",
        {now, longest_retry_ms});
}

/// For the dispatcher's sleep.
std::optional<std::int64_t> Store::next_retry() const {
    return reader()->integer("SELECT min(retry_at) FROM tasks WHERE state='retry_wait'");
}

namespace {

const std::string selected_attempts =
    R"(SELECT task, number, state, created, started, finished, exit_code, signal, wall_seconds,
    cpu_seconds FROM attempts )";

Attempt attempt_from(const Row& row) {
    return {.task = row.text("task"),
            .number = row.integer("number"),
            .state = attempt_state_named(row.text("state")),
            .created = row.text("created"),
            .started = row.optional_text("started"),
            .finished = row.optional_text("finished"),
            .exit_code = row.optional_integer("exit_code"),
            .signal = row.optional_integer("signal"),
            .wall_seconds = row.optional_real("wall_seconds"),
            .cpu_seconds = row.optional_real("cpu_seconds")};
}

const std::string selected_artifacts = "SELECT task, name, sha256, bytes FROM artifacts ";

Artifact artifact_from(const Row& row) {
    return {row.text("task"), row.text("name"), row.text("sha256"), row.integer("bytes")};
}

template <class Each>
std::map<std::string, std::vector<Each>> by_task(std::vector<Each> all) {
    std::map<std::string, std::vector<Each>> found;
    for (Each& each : all) found[each.task].push_back(std::move(each));
    return found;
}

}  // namespace

std::vector<Attempt> Store::attempts_of(const std::string& task) const {
    return reader()->select(selected_attempts + "WHERE task=? ORDER BY number", {task},
                            attempt_from);
}

std::map<std::string, std::vector<Attempt>> Store::attempts_between(const std::string& first,
                                                                    const std::string& last) const {
    return by_task(
        reader()->select(selected_attempts + "WHERE task>=? AND task<=? ORDER BY task, number",
                         {first, last}, attempt_from));
}

std::vector<Artifact> Store::artifacts_of(const std::string& task) const {
    return reader()->select(selected_artifacts + "WHERE task=? ORDER BY name", {task},
                            artifact_from);
}

std::map<std::string, std::vector<Artifact>> Store::artifacts_between(
    const std::string& first, const std::string& last) const {
    return by_task(
        reader()->select(selected_artifacts + "WHERE task>=? AND task<=? ORDER BY task, name",
                         {first, last}, artifact_from));
}

/// Any task with this content will do: the bytes are the same.
std::optional<Artifact> Store::artifact(const std::string& sha256) const {
    return reader()->first(selected_artifacts + "WHERE sha256=? LIMIT 1", {sha256}, artifact_from);
}

std::map<std::string, FactorsOfSafety> Store::factors_of_safety(const std::string& run) const {
    std::map<std::string, FactorsOfSafety> found;
    reader()->query("SELECT variant, json_extract(result, '$.factor_of_safety') AS intact, " +
                        factor_liquefied("result") +
                        " AS liquefied FROM tasks WHERE run=? AND phase=? AND result IS NOT NULL",
                    {run, phases::lem.program}, [&](const Row& row) {
                        found[row.text("variant")] = {row.optional_real("intact"),
                                                      row.optional_real("liquefied")};
                    });
    return found;
}

/// recipe NULL: it was not reusable, so there is no part of a scene to compare.
std::vector<AccuracyRung> Store::accuracy_rungs(std::size_t most_runs) const {
    // The condition on the study must equal that of the index runs_with_accuracy.
    return reader()->select(
        R"(SELECT run, variant, id, recipe FROM tasks WHERE run IN (SELECT id FROM runs
    WHERE json_type(study, '$.accuracy')='object' ORDER BY id DESC LIMIT ?)
    AND phase=? AND recipe IS NOT NULL ORDER BY run DESC, id)",
        {as_value(most_runs), phases::mpm.program}, [](const Row& row) {
            return AccuracyRung{.run = row.text("run"),
                                .variant = row.text("variant"),
                                .mpm_task = row.text("id"),
                                .recipe = row.text("recipe")};
        });
}

std::pair<std::int64_t, std::int64_t> Store::points_of(const std::string& run) const {
    const auto counts = reader()->first(
        R"(SELECT count(*) AS points, coalesce(sum(state IN ('succeeded', 'cached')), 0) AS done
FROM tasks WHERE run=? AND )" +
            makes_a_row("tasks"),
        {run}, [](const Row& row) {
            return std::pair{row.integer("points"), row.integer("done")};
        });
    return *counts;
}

/// A task in a cluster's queue does not count as running. The pace uses the last eight tasks: a
/// sweep goes from stable to flowing cases, so that early ones are not representative.
std::vector<PhaseLeft> Store::left_of(const std::string& run) const {
    return reader()->select(
        R"(SELECT sum(NOT runs) AS waiting, sum(runs) AS running,
    total(iif(runs, ran_for, 0.0)) AS running_for,
    (SELECT avg(seconds) FROM (SELECT (SELECT sum(wall_seconds) FROM attempts
         WHERE attempts.task=tasks.id) AS seconds FROM tasks
     WHERE run=?1 AND state='succeeded' AND phase=open.phase ORDER BY started DESC LIMIT 8)) AS pace
FROM (SELECT phase, state IN ('running', 'finalizing', 'cancelling') AS runs,
    (SELECT total(coalesce(wall_seconds, iif(finished IS NULL,
         (julianday('now') - julianday(started)) * 86400.0, NULL)))
     FROM attempts WHERE attempts.task=tasks.id) AS ran_for
    FROM tasks WHERE run=?1 AND finished IS NULL) AS open GROUP BY phase)",
        {run}, [](const Row& row) {
            return PhaseLeft{.waiting = row.integer("waiting"),
                             .running = row.integer("running"),
                             .running_for = row.real("running_for"),
                             .pace = row.optional_real("pace")};
        });
}

namespace {

json value_from(const Row& row, const ResultColumn& column) {
    const auto given = [](auto value) { return value ? json(*std::move(value)) : json(); };
    switch (column.kind) {
        case ColumnKind::number:
            return given(row.optional_real(column.name));
        case ColumnKind::yes_no:
            return given(row.optional_yes(column.name));
        case ColumnKind::word:
            return given(row.optional_text(column.name));
        case ColumnKind::flags:
            return given(row.optional_document(column.name));
    }
    return nullptr;
}

/// Reads rows with these columns.
auto result_from(std::span<const ResultColumn> columns) {
    return [columns](const Row& row) {
        ResultRow values;
        for (const ResultColumn& each : columns) values.push_back(value_from(row, each));
        return values;
    };
}

}  // namespace

std::vector<ResultRow> Store::results(const std::string& run, const ResultFilter& filter) const {
    std::string sql = "SELECT " + selected_result_columns() + " FROM sweep_results WHERE ";
    std::vector<Value> values{run, as_value(filter.most), as_value(filter.from)};
    if (filter.takes_all()) {
        sql += "run=?1 ORDER BY variant_place, transfer_time";
        values = {run};
    } else if (!filter.state && !filter.flag) {
        // Selects the page before it computes the rows.
        sql += R"(mpm_task IN (SELECT tasks.id FROM tasks LEFT JOIN variants
    ON variants.run=tasks.run AND variants.name=tasks.variant WHERE tasks.run=?1 AND )" +
               makes_a_row("tasks") + R"(
    ORDER BY coalesce(variants.place, 0), tasks.transfer_time LIMIT ?2 OFFSET ?3)
ORDER BY variant_place, transfer_time)";
    } else {
        sql += R"(run=?1 AND (?4 IS NULL OR state=?4)
    AND (?5 IS NULL OR instr(';' || flags || ';', ';' || ?5 || ';') > 0)
ORDER BY variant_place, transfer_time LIMIT ?2 OFFSET ?3)";
        values.push_back(value_or_null(filter.state));
        values.push_back(value_or_null(filter.flag));
    }
    std::vector<ResultRow> found = reader()->select(sql, values, result_from(result_columns()));
    for (ResultRow& each : found)
        if (!value_of(each, "runout").is_null())
            value_of(each, "lower_bound") =
                findings::still_moves(value_of(each, "at_rest"), value_of(each, "flags"));
    return found;
}

std::map<std::string, std::string> Store::repeated_variants(const std::string& run) const {
    std::map<std::string, std::string> found;
    reader()->query("SELECT name, draw_of FROM variants WHERE run=? AND draw_of IS NOT NULL", {run},
                    [&](const Row& row) { found.emplace(row.text("name"), row.text("draw_of")); });
    return found;
}

/// draw_of NULL: not a repeat. A mean is a lower bound as soon as one of its repeats is, hence
/// the disjunction in `moves`.
std::vector<ResultRow> Store::means(const std::string& run) const {
    const Reader database = reader();
    if (!database->finds("SELECT 1 FROM variants WHERE run=? AND draw_of IS NOT NULL LIMIT 1",
                         {run}))
        return {};
    std::map<std::pair<json, json>, bool> moves;  // by variant and transfer time
    const auto given = [](auto value) { return value ? json(*std::move(value)) : json(); };
    database->query(
        R"(SELECT draw_of, transfer_time, at_rest, flag_list FROM sweep_results
WHERE run=? AND draw_of IS NOT NULL AND runout IS NOT NULL)",
        {run}, [&](const Row& row) {
            moves[{row.text("draw_of"), given(row.optional_real("transfer_time"))}] |=
                findings::still_moves(given(row.optional_yes("at_rest")),
                                      given(row.optional_document("flag_list")));
        });
    auto found = database->select("SELECT " + selected_mean_columns() + " FROM (" +
                                      selected_means("AND run=?") +
                                      ") ORDER BY variant_place, transfer_time",
                                  {run}, result_from(mean_columns()));
    for (ResultRow& each : found) {
        const auto value = [&](const char* name) -> json& {
            return value_of(each, name, mean_columns());
        };
        const auto known = moves.find({value("variant"), value("transfer_time")});
        if (known != moves.end()) value("lower_bound") = known->second;
    }
    return found;
}

namespace {

Event event_from(const Row& row) {
    return {.seq = row.integer("seq"),
            .time = row.text("time"),
            .run = row.text("run"),
            .task = row.optional_text("task"),
            .kind = row.text("kind"),
            .detail = row.document("detail")};
}

const std::string selected_events = "SELECT seq, time, run, task, kind, detail FROM events ";

}  // namespace

/// From memory if possible: each open page and client waits for the newest events, and would
/// otherwise query after every commit.
std::vector<Event> Store::events_after(std::int64_t seq, std::size_t most) const {
    {
        const std::lock_guard lock(events_mutex_);
        if (auto recent = recent_events_.after(seq, most)) return *std::move(recent);
    }
    return reader()->select(selected_events + "WHERE seq>? ORDER BY seq LIMIT ?",
                            {seq, as_value(most)}, event_from);
}

std::vector<Event> Store::events_of_run(const std::string& run, std::int64_t after,
                                        std::size_t most) const {
    return reader()->select(selected_events + "WHERE run=? AND seq>? ORDER BY seq LIMIT ?",
                            {run, after, as_value(most)}, event_from);
}

}  // namespace breach::orchestrator
