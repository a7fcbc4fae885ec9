// What a run's verdict follows from, gathered by queries that do not grow with lists of runs: services/findings judges it.
#include <algorithm>

#include "core/phases/phases.hpp"
#include "services/orchestrator/store/store.hpp"
#include "services/orchestrator/store/views.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

Run& run_named(std::vector<Run>& runs, const std::string& id) {
    return *std::ranges::find(runs, id, &Run::id);
}

void add_flags(Connection& database, const std::string& ids, std::vector<Run>& runs) {
    database.query(
        R"sql(
SELECT flags.run, code, flags.phase, severity = 'questionable', count(DISTINCT task),
    (SELECT count(*) FROM tasks AS every WHERE every.run = flags.run AND every.phase = flags.phase
        AND every.state IN ('succeeded', 'cached')),
    message, pointer, min(label)
FROM flags JOIN tasks ON tasks.id = task WHERE flags.run IN (SELECT value FROM json_each(?))
GROUP BY flags.run, severity, code, flags.phase ORDER BY flags.run, severity, code, flags.phase)sql",
        {ids}, [&](const Row& row) {
            const auto severity =
                row.integer(3) != 0 ? fault::Severity::questionable : fault::Severity::warning;
            run_named(runs, row.text(0))
                .facts.raised.push_back({{row.text(1), severity, row.text(6), row.text(7)},
                                         row.text(2),
                                         row.integer(4),
                                         row.integer(5),
                                         row.text(8)});
        });
}

/// Samples are meant to fail in part: their probability is the answer, not a fault of the study.
void add_unstable(Connection& database, const std::string& ids, std::vector<Run>& runs) {
    database.query(R"sql(
SELECT tasks.run, count(*), min(json_extract(result, '$.factor_of_safety')), variant,
    (SELECT count(*) FROM tasks AS every WHERE every.run = tasks.run AND every.phase = 'lem_tool'
        AND every.state IN ('succeeded', 'cached'))
FROM tasks JOIN runs ON runs.id = tasks.run
WHERE run IN (SELECT value FROM json_each(?)) AND phase = 'lem_tool'
    AND json_extract(result, '$.factor_of_safety') < 1
    AND json_extract(study, '$.uncertainty') IS NULL
    AND NOT coalesce(json_extract(study, '$.known_failure'), 0)
GROUP BY tasks.run)sql",
                   {ids}, [&](const Row& row) {
                       run_named(runs, row.text(0)).facts.unstable = findings::Unstable{
                           row.integer(1), row.integer(4), row.real(2), row.text(3)};
                   });
}

void add_early(Connection& database, const std::string& ids, std::vector<Run>& runs) {
    database.query(R"sql(
SELECT fem.run, sum(transfer.transfer_time < liquefied), count(*),
    min(CASE WHEN transfer.transfer_time < liquefied THEN transfer.transfer_time END), liquefied
FROM (SELECT id, run, json_extract(result, '$.milestones.liquefied.time') AS liquefied FROM tasks
      WHERE run IN (SELECT value FROM json_each(?)) AND phase = 'fem_solver' AND result IS NOT NULL) AS fem
JOIN tasks AS transfer ON transfer.parent = fem.id AND transfer.phase = 'transfer_tool'
    AND transfer.state IN ('succeeded', 'cached')
GROUP BY fem.run)sql",
                   {ids}, [&](const Row& row) {
                       if (row.is_null(1) || row.integer(1) == 0) return;
                       run_named(runs, row.text(0)).facts.early = findings::Early{
                           row.integer(1), row.integer(2), row.real(3), row.real(4)};
                   });
}

void add_broken(Connection& database, const std::string& ids, std::vector<Run>& runs) {
    database.query(
        R"sql(
SELECT run, phase, count(*),
    (SELECT count(*) FROM tasks AS every WHERE every.run = tasks.run AND every.phase = tasks.phase),
    coalesce(fault_summary, state), min(label)
FROM tasks WHERE run IN (SELECT value FROM json_each(?))
    AND state IN ('failed', 'skipped', 'cancelled') AND NOT not_reached
GROUP BY run, phase ORDER BY phase)sql",
        {ids}, [&](const Row& row) {
            run_named(runs, row.text(0))
                .facts.broken.push_back({row.text(1), row.integer(2), row.integer(3), row.text(4)});
        });
}

/// Of runs that are over. Looked for only where a FEM with expired triggers has no transfer: plans of many samples are long.
void add_without_transfer(Connection& database, std::vector<Run>& runs) {
    for (Run& each : runs) {
        bool some = false;
        if (each.finished)
            database.query("SELECT 1 FROM triggers WHERE run=? AND state='expired' AND NOT (" +
                               draws_samples("spec") +
                               ") AND NOT EXISTS (SELECT 1 FROM tasks AS child WHERE "
                               "child.parent=triggers.fem_task) LIMIT 1",
                           {each.id}, [&](const Row&) { some = true; });
        if (!some) continue;
        for (WithoutTransfer& found : variants_without_transfer(database, each.id))
            each.facts.without_transfer.push_back(
                {std::move(found.variant), found.stood, std::move(found.reason)});
    }
}

}  // namespace

void Store::gather_facts(Connection& database, std::vector<Run>& runs) {
    json list = json::array();
    for (Run& each : runs) {
        each.facts.state = each.state;
        if (each.tasks_ended > 0) list.push_back(each.id);  // facts come with results
    }
    if (list.empty()) return;
    const std::string ids = list.dump();
    database.query(
        "SELECT run, runouts FROM run_counts WHERE run IN (SELECT value FROM json_each(?))", {ids},
        [&](const Row& row) {
            run_named(runs, row.text(0)).facts.has_runout = row.integer(1) > 0;
        });
    add_flags(database, ids, runs);
    add_unstable(database, ids, runs);
    add_early(database, ids, runs);
    add_broken(database, ids, runs);
    add_without_transfer(database, runs);
    for (Run& each : runs)
        if (const std::string line = line_of(findings::verdict_of(each.facts)); !line.empty())
            each.message += (each.message.empty() ? "" : "; ") + line;
}

}  // namespace breach::orchestrator
