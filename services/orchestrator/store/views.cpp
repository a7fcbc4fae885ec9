// Views and the indexes that serve them. The views are made from result_columns(), so that a
// column of the results stands in one place; sqlite_master keeps their text, and a service with
// another text makes them anew at its start. A view costs nothing until it is read, and reads the
// tables as they are.
#include "services/orchestrator/store/views.hpp"

#include <algorithm>
#include <cassert>
#include <vector>

#include "core/phases/phases.hpp"
#include "services/orchestrator/records/mean_columns.hpp"

namespace breach::orchestrator {

namespace {

// A run with an open trigger is not over: it may still get tasks. A run without a runout did not
// fail if its FEM reached no transfer time, if it consists of lem_tool alone, or if no trigger
// fired.
const char* const run_summaries = R"sql(
SELECT id, name, title, created, started, paused, sweep, total AS tasks_total, reached AS tasks_done,
    ended AS tasks_ended, failed AS tasks_failed,
    CASE WHEN EXISTS (SELECT 1 FROM flags WHERE flags.run = id AND severity = 'questionable')
         THEN (SELECT count(DISTINCT task) FROM flags WHERE flags.run = id AND severity = 'questionable')
         ELSE 0 END AS questionable,
    warnings,
    CASE WHEN is_open THEN CASE WHEN started IS NULL THEN 'queued' ELSE 'running' END
         WHEN cancelled > 0 THEN 'cancelled'
         WHEN failed > 0 AND (runouts > 0 OR reached > 0 AND NOT EXISTS (SELECT 1 FROM tasks
             WHERE tasks.run = counted.id AND phase <> 'lem_tool')) THEN 'partial'
         WHEN failed > 0 THEN 'failed'
         WHEN reached < ended AND runouts = 0 THEN 'partial'
         WHEN runouts = 0 AND EXISTS (SELECT 1 FROM triggers WHERE triggers.run = counted.id
             AND triggers.state = 'expired') THEN 'partial'
         WHEN EXISTS (SELECT 1 FROM flags WHERE flags.run = id AND severity = 'questionable')
             THEN 'questionable'
         ELSE 'succeeded' END AS state,
    CASE WHEN NOT is_open THEN last_finished END AS finished
FROM (SELECT *, ended < total OR EXISTS (SELECT 1 FROM triggers
        WHERE triggers.run = runs.id AND triggers.state IN ('armed', 'holding'))
        OR EXISTS (SELECT 1 FROM batches WHERE batches.run = runs.id AND state = 'open') AS is_open
      FROM runs JOIN run_counts ON run_counts.run = runs.id) AS counted)sql";

/// When each trigger fired, and the delays of its snapshot and its transfer.
const char* const trigger_firings = R"sql(
SELECT triggers.run AS run, triggers.id AS trigger, triggers.name AS name, triggers.kind AS kind,
    firings.transfer_time AS transfer_time, firings.wanted_time AS wanted_time,
    firings.transfer_time - firings.wanted_time AS lag_s,
    firings.snapshot AS snapshot, firings.sha256 AS sha256, firings.crossed AS crossed,
    firings.fem_step AS fem_step, firings.noticed_at AS noticed_at,
    firings.written_at - firings.noticed_at AS snapshot_ms,
    firings.fired_at - firings.noticed_at AS fired_ms,
    (SELECT cast(round((julianday(min(attempts.started)) - 2440587.5) * 86400000.0) AS INTEGER)
        - firings.noticed_at
     FROM tasks JOIN attempts ON attempts.task = tasks.id
     WHERE tasks.parent = triggers.fem_task AND tasks.input = firings.snapshot) AS start_ms
FROM firings JOIN triggers ON triggers.id = firings.trigger)sql";

struct Expression {
    std::string name;
    std::string sql;
};

// A row has the flags of the MPM and of the two tasks before it: a questionable FEM makes the
// runout questionable.
const std::string tasks_of_row = "(mpm.id, transfer.id, transfer.parent)";
const std::string is_questionable = "EXISTS (SELECT 1 FROM flags WHERE flags.task IN " +
                                    tasks_of_row + " AND flags.severity = 'questionable')";
/// From the variant's own stability analysis, or the shared one.
std::string of_stability(const std::string& what, const std::string& phase = phases::lem.program) {
    return "(SELECT " + what + R"( FROM tasks AS lem
        WHERE lem.run = mpm.run AND lem.phase = ')" +
           phase + R"('
        AND lem.variant IN (mpm.variant, '') ORDER BY lem.variant DESC LIMIT 1))";
}

/// Columns that result.json does not contain.
const std::vector<Expression> own_columns{
    {"transfer_time", "mpm.transfer_time"},
    {"state",
     R"(CASE WHEN transfer.not_reached THEN 'not_reached'
        WHEN transfer.state IN ('failed', 'skipped') THEN transfer.state
        WHEN mpm.result IS NOT NULL AND )" +
         is_questionable + R"( THEN 'questionable'
        WHEN mpm.state = 'cached' THEN 'succeeded' ELSE mpm.state END)"},
    {"reason", "coalesce(transfer.fault_summary, mpm.fault_summary, '')"},
    {"transfer_task", "transfer.id"},
    {"mpm_task", "mpm.id"},
    {"variant", "mpm.variant"},
    {"reused", "mpm.state = 'cached'"},
    {"trigger",
     R"(CASE WHEN transfer.id IS NULL THEN '' ELSE coalesce((SELECT group_concat(triggers.name, ' ') FROM triggers
        JOIN firings ON firings.trigger = triggers.id
        WHERE triggers.fem_task = transfer.parent AND firings.snapshot = transfer.input), 'at_time') END)"},
    {"factor_of_safety", of_stability("json_extract(lem.result, '$.factor_of_safety')")},
    {"factor_of_safety_liquefied", of_stability(factor_liquefied("lem.result"))},
    // A snapshot was written for this very transfer: times in text are equal to a microsecond.
    {"factor_of_safety_post_seismic",
     of_stability(R"((SELECT json_extract(row.value, '$.factor_of_safety')
        FROM json_each(lem.result, '$.after_shaking') AS row
        WHERE abs(json_extract(row.value, '$.time') - mpm.transfer_time) < 1e-6))",
                  phases::post_seismic.program)},
    {"questionable", "CASE WHEN mpm.result IS NOT NULL THEN " + is_questionable + " END"},
    {"flags",
     R"(CASE WHEN mpm.result IS NOT NULL THEN coalesce((SELECT group_concat(code, ';') FROM
        (SELECT code FROM flags WHERE task IN )" +
         tasks_of_row + " GROUP BY code ORDER BY min(severity), code)), '') END"},
};
/// Columns computed outside the database (services/findings, accuracy/runout_error.hpp): not in the
/// view.
const std::vector<std::string> worked_out{"lower_bound", "runout_error", "runout_error_from"};

bool is_in_view(const ResultColumn& column) {
    return std::ranges::find(worked_out, column.name) == worked_out.end();
}

/// Columns of the view that the table of results does not have.
const std::vector<Expression> other_columns{
    {"run", "mpm.run"},
    {"variant_place", "coalesce(variants.place, 0)"},
    {"draw_of", "variants.draw_of"},
    {"flag_list",
     R"(CASE WHEN mpm.result IS NOT NULL THEN (SELECT json_group_array(json_object('code', code, 'severity', severity,
        'message', message, 'pointer', pointer, 'phase', phase)) FROM
        (SELECT code, severity, message, pointer, phase, min(task) FROM flags WHERE task IN )" +
         tasks_of_row + R"(
        GROUP BY code, severity, pointer ORDER BY severity, code, pointer)) END)"},
};

/// "/energy/numerical/share" -> "$.energy.numerical.share"
std::string json_path(std::string pointer) {
    std::ranges::replace(pointer, '/', '.');
    return "$" + pointer;
}

std::string sql_of(const ResultColumn& column) {
    if (*column.pointer != '\0')
        return "json_extract(mpm.result, '" + json_path(column.pointer) + "')";
    const auto own = std::ranges::find(own_columns, column.name, &Expression::name);
    assert(own != own_columns.end());
    return own->sql;
}

/// One row per variant and transfer time: the runout, or why there is none. A static scene has no
/// transfer; without an MPM, `mpm` is the stability analysis.
std::string sweep_results() {
    std::string columns;
    for (const Expression& each : other_columns)
        columns.append(columns.empty() ? "\nSELECT " : ",\n    ")
            .append(each.sql)
            .append(" AS ")
            .append(each.name);
    for (const ResultColumn& each : result_columns())
        if (is_in_view(each))
            columns.append(",\n    ").append(sql_of(each)).append(" AS ").append(each.name);
    return columns +
           "\nFROM tasks AS mpm LEFT JOIN tasks AS transfer ON transfer.id = mpm.parent"
           "\n    LEFT JOIN variants ON variants.run = mpm.run AND variants.name = mpm.variant"
           "\nWHERE " +
           makes_a_row("mpm");
}

// Columns of the means besides the means themselves. A waiting or running repeat has no result yet.
// The mean leaves out repeats that ended without a result, and counts them.
const std::string is_open =
    "state NOT IN ('succeeded', 'questionable', 'failed', 'skipped', "
    "'not_reached', 'cancelled')";
const std::vector<Expression> columns_of_means{
    {"transfer_time", "transfer_time"},
    {"variant", "draw_of"},
    {"state", "CASE WHEN sum(" + is_open + R"() > 0 THEN 'running'
        WHEN count(runout) = 0 THEN min(state)
        WHEN count(runout) < count(*) THEN 'partial'
        WHEN sum(state = 'questionable') > 0 THEN 'questionable' ELSE 'succeeded' END)"},
    {"draws", "count(*)"},
    {"draws_done", "count(runout)"},
    {"missing_draws",
     "coalesce(group_concat(CASE WHEN runout IS NULL THEN variant || ': ' || state END, '; '), "
     "'')"},
    {"questionable_draws",
     "coalesce(group_concat(CASE WHEN questionable AND runout IS NOT NULL THEN variant END, '; '),"
     " '')"},
};

/// Views by name, with their statements.
std::vector<Expression> views() {
    return {{"trigger_firings", std::string("CREATE VIEW trigger_firings AS") + trigger_firings},
            {"run_summaries", std::string("CREATE VIEW run_summaries AS") + run_summaries},
            {"sweep_results", "CREATE VIEW sweep_results AS" + sweep_results()},
            {"sweep_means", "CREATE VIEW sweep_means AS" + selected_means("")}};
}

bool is_there(Connection& database, const Expression& view) {
    return database.finds("SELECT 1 FROM sqlite_master WHERE type='view' AND name=? AND sql=?",
                          {view.name, view.sql});
}

}  // namespace

bool views_are_current(Connection& database) {
    return std::ranges::all_of(views(),
                               [&](const Expression& each) { return is_there(database, each); });
}

void make_views(Connection& database) {
    // Indexes for the facts in lists of runs (run_facts.cpp).
    database.script(
        R"(CREATE INDEX IF NOT EXISTS tasks_by_runout ON tasks(run, json_extract(result, '$.runout'), variant,
    transfer_time, id) WHERE phase = 'mpm_solver' AND result IS NOT NULL;
CREATE INDEX IF NOT EXISTS tasks_by_factor ON tasks(run, json_extract(result, '$.factor_of_safety'))
    WHERE phase = 'lem_tool' AND result IS NOT NULL;)");
    for (const Expression& each : views()) {
        if (is_there(database, each)) continue;
        database.script("DROP VIEW IF EXISTS " + each.name);
        database.script(each.sql);
    }
}

std::string factor_liquefied(const std::string& result) {
    return "CASE WHEN json_extract(" + result + ", '$.stages[#-1].layers_liquefied') > 0 THEN " +
           "json_extract(" + result + ", '$.stages[#-1].factor_of_safety') END";
}

/// The rows of a table of results: every MPM task, or every stability analysis of a run that
/// consists of nothing else.
std::string makes_a_row(const std::string& task) {
    return "(" + task + ".phase = '" + phases::mpm.program + "' OR " + task + ".phase = '" +
           phases::lem.program +
           "' AND NOT EXISTS (SELECT 1 FROM tasks AS other WHERE other.run = " + task +
           ".run AND other.phase <> '" + phases::lem.program + "'))";
}

/// The deviation is summed from differences to the mean: the difference of squares would lose its
/// digits. With one repeat, division by zero gives NULL: no deviation. condition stands inside
/// the subquery, where SQLite can use it before the window.
std::string selected_means(const std::string& condition) {
    std::string off;
    std::string columns;
    for (const ResultColumn* each : averaged_columns()) {
        const std::string name = each->name;
        off += ",\n        " + name + " - avg(" + name + ") OVER place AS " + name + "_off";
        columns += ",\n    avg(" + name + ") AS " + name + ",\n    sqrt(sum(" + name + "_off * " +
                   name + "_off) / (count(" + name + ") - 1)) AS " + deviation_of(name);
    }
    std::string others;
    for (const Expression& each : columns_of_means)
        others.append(",\n    ").append(each.sql).append(" AS ").append(each.name);
    return "\nSELECT run, min(variant_place) AS variant_place" + others + columns +
           "\nFROM (SELECT *" + off + "\n    FROM sweep_results WHERE draw_of IS NOT NULL " +
           condition +
           "\n    WINDOW place AS (PARTITION BY run, draw_of, transfer_time))"
           "\nGROUP BY run, draw_of, transfer_time";
}

std::string selected_mean_columns() {
    std::string names;
    for (const ResultColumn& each : mean_columns())
        names.append(names.empty() ? "" : ", ")
            .append(is_in_view(each) ? "" : "NULL AS ")
            .append(each.name);
    return names;
}

std::string selected_result_columns() {
    std::string names;
    for (const ResultColumn& each : result_columns())
        names.append(names.empty() ? "" : ", ")
            .append(!is_in_view(each)                ? "NULL AS "
                    : each.kind == ColumnKind::flags ? "flag_list AS "
                                                     : "")
            .append(each.name);
    return names;
}

}  // namespace breach::orchestrator
