// Collects the facts for a run's verdict, which services/findings judges. Called for every read of
// a run or a page of runs. Most queries take all runs of the page at once.
#include <algorithm>

#include "core/phases/phases.hpp"
#include "services/findings/flags.hpp"
#include "services/findings/governing.hpp"
#include "services/orchestrator/store/store.hpp"
#include "services/orchestrator/store/views.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

/// A page has some dozen runs, so a search is cheaper than an index.
Run& run_named(std::vector<Run>& runs, const std::string& id) {
    return *std::ranges::find(runs, id, &Run::id);
}

void add_flags(Connection& database, const std::string& ids, std::vector<Run>& runs) {
    database.query(
        R"(SELECT flags.run AS run, code, flags.phase AS phase, severity = 'questionable' AS questionable,
    count(DISTINCT task) AS tasks,
    (SELECT count(*) FROM tasks AS every WHERE every.run = flags.run AND every.phase = flags.phase
        AND every.state IN ('succeeded', 'cached')) AS of_tasks, message, pointer, min(label) AS first
FROM flags JOIN tasks ON tasks.id = task WHERE flags.run IN (SELECT value FROM json_each(?))
GROUP BY flags.run, severity, code, flags.phase ORDER BY flags.run, severity, code, flags.phase)",
        {ids}, [&](const Row& row) {
            const auto severity =
                row.yes("questionable") ? fault::Severity::questionable : fault::Severity::warning;
            run_named(runs, row.text("run"))
                .facts.raised.push_back(
                    {{row.text("code"), severity, row.text("message"), row.text("pointer")},
                     row.text("phase"),
                     row.integer("tasks"),
                     row.integer("of_tasks"),
                     row.text("first")});
        });
}

/// Apart from add_flags: a flag may be a warning of one result and make another questionable.
void add_flag_counts(Connection& database, const std::string& ids, std::vector<Run>& runs) {
    database.query(
        R"(SELECT run, code, max(tasks) AS tasks FROM (
    SELECT run, code, phase, count(DISTINCT task) AS tasks FROM flags
    WHERE run IN (SELECT value FROM json_each(?)) GROUP BY run, code, phase) GROUP BY run, code)",
        {ids}, [&](const Row& row) {
            run_named(runs, row.text("run")).flag_counts[row.text("code")] = row.integer("tasks");
        });
}

/// Excludes samples: some are expected to fail, and their share is the result.
void add_unstable(Connection& database, const std::string& ids, std::vector<Run>& runs) {
    database.query(
        R"(SELECT tasks.run AS run, count(*) AS tasks,
    min(json_extract(result, '$.factor_of_safety')) AS factor, variant,
    (SELECT count(*) FROM tasks AS every WHERE every.run = tasks.run AND every.phase = 'lem_tool'
        AND every.state IN ('succeeded', 'cached')) AS of_tasks
FROM tasks JOIN runs ON runs.id = tasks.run
WHERE run IN (SELECT value FROM json_each(?)) AND phase = 'lem_tool'
    AND json_extract(result, '$.factor_of_safety') < 1
    AND json_extract(study, '$.uncertainty') IS NULL
    AND NOT coalesce(json_extract(study, '$.known_failure'), 0)
GROUP BY tasks.run)",
        {ids}, [&](const Row& row) {
            run_named(runs, row.text("run")).facts.unstable =
                findings::Unstable{row.integer("tasks"), row.integer("of_tasks"),
                                   row.real("factor"), row.text("variant")};
        });
}

/// Transfers before the FEM's liquefaction: the runout then begins from soil that is still
/// strong. NULL comparisons are no counts: a FEM in which nothing liquefied drops out.
void add_early(Connection& database, const std::string& ids, std::vector<Run>& runs) {
    database.query(
        R"(SELECT fem.run AS run, sum(transfer.transfer_time < liquefied) AS early, count(*) AS transfers,
    min(CASE WHEN transfer.transfer_time < liquefied THEN transfer.transfer_time END) AS first, liquefied
FROM (SELECT id, run, json_extract(result, '$.milestones.liquefied.time') AS liquefied FROM tasks
      WHERE run IN (SELECT value FROM json_each(?)) AND phase = 'fem_solver' AND result IS NOT NULL) AS fem
JOIN tasks AS transfer ON transfer.parent = fem.id AND transfer.phase = 'transfer_tool'
    AND transfer.state IN ('succeeded', 'cached')
GROUP BY fem.run)",
        {ids}, [&](const Row& row) {
            if (row.integer("early") == 0) return;  // or nothing liquefied
            run_named(runs, row.text("run")).facts.early =
                findings::Early{row.integer("early"), row.integer("transfers"), row.real("first"),
                                row.real("liquefied")};
        });
}

/// Grouped by phase, with one of the reasons; not_reached is no failure (add_not_reached).
void add_broken(Connection& database, const std::string& ids, std::vector<Run>& runs) {
    database.query(
        R"(SELECT run, phase, count(*) AS tasks,
    (SELECT count(*) FROM tasks AS every WHERE every.run = tasks.run AND every.phase = tasks.phase)
        AS of_tasks, coalesce(fault_summary, state) AS why, min(label)
FROM tasks WHERE run IN (SELECT value FROM json_each(?))
    AND state IN ('failed', 'skipped', 'cancelled') AND NOT not_reached
GROUP BY run, phase ORDER BY phase)",
        {ids}, [&](const Row& row) {
            run_named(runs, row.text("run"))
                .facts.broken.push_back({row.text("phase"), row.integer("tasks"),
                                         row.integer("of_tasks"), row.text("why")});
        });
}

/// For ended runs: variants whose FEM ended before all their transfer times. Excludes samples,
/// which count as failed.
void add_not_reached(Connection& database, const std::string& ids, std::vector<Run>& runs) {
    database.query(
        R"(SELECT run, variant, min(fault_summary) AS why FROM tasks JOIN runs ON runs.id = tasks.run
WHERE run IN (SELECT value FROM json_each(?)) AND phase = ?
    AND json_extract(study, '$.uncertainty') IS NULL
GROUP BY run, variant HAVING min(not_reached) ORDER BY run, min(tasks.id))",
        {ids, phases::mpm.program}, [&](const Row& row) {
            Run& of = run_named(runs, row.text("run"));
            if (of.finished)
                of.facts.without_transfer.push_back(
                    {row.text("variant"), false, row.text("why"), "/transfer_times"});
        });
}

/// For ended runs. Looks only where a FEM with expired triggers has no transfer: plans of many
/// samples are long.
void add_without_transfer(Connection& database, std::vector<Run>& runs) {
    for (Run& each : runs) {
        const bool some = each.finished &&
                          database.finds(R"(SELECT 1 FROM triggers WHERE run=? AND state='expired'
    AND NOT EXISTS (SELECT 1 FROM tasks AS child WHERE child.parent=triggers.fem_task) LIMIT 1)",
                                         {each.id});
        if (!some) continue;
        for (WithoutTransfer& found : variants_without_transfer(database, each.id))
            each.facts.without_transfer.push_back(
                {std::move(found.variant), found.stood, std::move(found.reason)});
    }
}

std::optional<LeastFactor> least_factor(Connection& database, const std::string& run) {
    return database.first(
        "SELECT id, variant, json_extract(result, '$.factor_of_safety') AS factor, " +
            factor_liquefied("result") + R"( AS liquefied,
    (SELECT min(json_extract(result, '$.factor_of_safety')) FROM tasks
     WHERE run=?1 AND phase='post_seismic') AS after_shaking
FROM tasks WHERE run=?1 AND phase='lem_tool' AND result IS NOT NULL
    AND json_extract(result, '$.factor_of_safety') IS NOT NULL
ORDER BY json_extract(result, '$.factor_of_safety') LIMIT 1)",
        {run}, [](const Row& row) {
            return LeastFactor{row.text("id"), row.text("variant"), row.real("factor"),
                               row.optional_real("liquefied"), row.optional_real("after_shaking")};
        });
}

/// draw_of: the repeated variant; nothing: not a repeat.
struct Runout {
    GoverningResult result;
    std::optional<std::string> draw_of;
};

/// Uses an index only (store/views.cpp): a run may have thousands.
std::vector<Runout> runouts_of(Connection& database, const std::string& run) {
    return database.select(
        R"(SELECT id, variant, transfer_time, json_extract(result, '$.runout') AS runout,
    (SELECT draw_of FROM variants WHERE variants.run=tasks.run AND name=variant) AS draw_of
FROM tasks WHERE run=? AND phase='mpm_solver' AND result IS NOT NULL
    AND json_extract(result, '$.runout') IS NOT NULL)",
        {run}, [](const Row& row) {
            return Runout{{.task = row.text("id"),
                           .variant = row.text("variant"),
                           .transfer_time = row.optional_real("transfer_time"),
                           .runout = row.real("runout")},
                          row.optional_text("draw_of")};
        });
}

/// Means over the repeats at one transfer time, as the table of means has them.
std::vector<findings::Candidate> candidates_among(const std::vector<Runout>& runouts) {
    const auto place = [](const Runout& each) {
        return std::pair(*each.draw_of, each.result.transfer_time);
    };
    std::map<std::pair<std::string, std::optional<double>>, std::pair<double, int>> sums;
    for (const Runout& each : runouts) {
        if (!each.draw_of) continue;
        auto& [sum, count] = sums[place(each)];
        sum += *each.result.runout;
        ++count;
    }
    std::vector<findings::Candidate> candidates;
    for (const Runout& each : runouts) {
        candidates.push_back({.runout = each.result.runout});
        if (!each.draw_of) continue;
        const auto& [sum, count] = sums.at(place(each));
        candidates.back().mean_runout = sum / count;
    }
    return candidates;
}

void add_governing(Connection& database, Run& run) {
    std::vector<Runout> runouts = runouts_of(database, run.id);
    std::vector<findings::Candidate> candidates = candidates_among(runouts);
    if (run.stability) candidates.push_back({.factor_of_safety = run.stability->factor_of_safety});
    const auto place = findings::governing(candidates);
    if (!place) return;
    // The last candidate is the stability analysis.
    if (*place == runouts.size()) {
        run.governing = {run.stability->task, run.stability->variant};
        return;
    }
    run.governing = std::move(runouts[*place].result);
    const json result = database
                            .first("SELECT result FROM tasks WHERE id=?", {run.governing->task},
                                   [](const Row& row) { return row.document("result"); })
                            .value();
    run.governing->lower_bound = findings::still_moves(result);
    run.governing->soil = findings::soil_of(result);
    const bool samples = database.finds(
        "SELECT 1 FROM runs WHERE id=? AND json_extract(study, '$.uncertainty') IS NOT NULL",
        {run.id});
    // The farthest of many samples is an extreme, and the headline says so.
    if (samples && run.governing->soil)
        run.governing->soil->worst_of = static_cast<std::int64_t>(runouts.size());
    if (const json depth = result.value("depth_beyond_toe", json()); depth.is_number())
        run.governing->depth_beyond_toe = depth;
}

}  // namespace

void Store::gather_facts(Connection& database, std::vector<Run>& runs) {
    json list = json::array();
    for (Run& each : runs) {
        if (each.tasks_ended > 0) list.push_back(each.id);  // without results there are no facts
    }
    if (list.empty()) return;
    const std::string ids = list.dump();
    database.query(
        "SELECT run, runouts FROM run_counts WHERE run IN (SELECT value FROM json_each(?))", {ids},
        [&](const Row& row) {
            run_named(runs, row.text("run")).facts.has_runout = row.integer("runouts") > 0;
        });
    add_flags(database, ids, runs);
    add_flag_counts(database, ids, runs);
    add_unstable(database, ids, runs);
    add_early(database, ids, runs);
    add_broken(database, ids, runs);
    add_not_reached(database, ids, runs);
    add_without_transfer(database, runs);
    for (Run& each : runs) {
        if (each.tasks_ended == 0) continue;
        each.stability = least_factor(database, each.id);
        each.lem_alone = !database.finds("SELECT 1 FROM tasks WHERE run=? AND phase<>? LIMIT 1",
                                         {each.id, phases::lem.program});
        add_governing(database, each);
        if (const std::string line = line_of(findings::verdict_of(each.facts)); !line.empty())
            each.message += (each.message.empty() ? "" : "; ") + line;
    }
}

}  // namespace breach::orchestrator
