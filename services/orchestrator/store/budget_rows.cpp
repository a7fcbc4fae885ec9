// Budgets of runs, and the cost of the tasks that exhausted runs still lack.
#include <cmath>
#include <map>

#include "core/words/number.hpp"
#include "services/orchestrator/records/or_null.hpp"
#include "services/orchestrator/store/store.hpp"

namespace breach::orchestrator {

using nlohmann::json;

void Transaction::set_budget(const std::string& run, std::optional<double> cpu_seconds) {
    database_.change(
        R"(UPDATE runs SET budget_cpu_seconds=?2,
    study=CASE WHEN ?2 IS NULL THEN json_remove(study, '$.budget')
        ELSE json_set(study, '$.budget', json_object('cpu_seconds', ?2)) END WHERE id=?1)",
        {run, value_or_null(cpu_seconds)});
    add_run_event(run, {{"event", "set_budget"}, {"cpu_seconds", or_null(cpu_seconds)}});
}

bool Transaction::is_exhausted(const std::string& run) const {
    return database_.finds(R"(SELECT 1 FROM runs JOIN spendings ON spendings.run=id
WHERE id=? AND cpu_seconds>=budget_cpu_seconds)",
                           {run});
}

namespace {

struct MissingTasks {
    std::int64_t waiting = 0;
    double mean = 0.0;  ///< of the phase's ended tasks [CPU s]; 0: none has ended
};

std::map<std::string, MissingTasks> missing_in(Connection& database, const std::string& run) {
    std::map<std::string, MissingTasks> missing;
    database.query(
        R"(SELECT phase, sum(finished IS NULL) AS waiting,
    coalesce((SELECT sum(attempts.cpu_seconds) / count(DISTINCT ran.id)
        FROM tasks AS ran JOIN attempts ON attempts.task=ran.id
        WHERE ran.run=?1 AND ran.phase=tasks.phase AND attempts.cpu_seconds>0), 0.0) AS mean
FROM tasks WHERE run=?1 GROUP BY phase HAVING sum(finished IS NULL)>0)",
        {run}, [&](const Row& row) {
            missing[row.text("phase")] = {row.integer("waiting"), row.real("mean")};
        });
    return missing;
}

/// Rounds up to two digits, as a proposal for a budget.
double rounded_up(double value) {
    const double step = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
    return std::ceil(value / step) * step;
}

std::string what_is_missing(const Run& run, const std::map<std::string, MissingTasks>& missing) {
    std::int64_t waiting = 0;
    double more = 0.0;
    std::string phases;
    std::string unknown;
    for (const auto& [phase, each] : missing) {
        waiting += each.waiting;
        more += static_cast<double>(each.waiting) * each.mean;
        phases += (phases.empty() ? "" : ", ") + std::to_string(each.waiting) + " " + phase;
        if (each.mean == 0.0) unknown += (unknown.empty() ? "" : ", ") + phase;
    }
    const double wanted = rounded_up(std::max(run.spent + more, 1.1 * run.spent));
    std::string text = "budget exhausted: " + words::text_of(run.spent, 4) + " of " +
                       words::text_of(*run.budget, 4) + " CPU s spent, " + std::to_string(waiting) +
                       " of " + std::to_string(run.tasks_total) + " tasks not done";
    if (waiting > 0) text += " (" + phases + ")";
    if (more > 0.0)
        text += "; from the cost of such tasks they need about " + words::text_of(more, 2) +
                " CPU s more";
    if (!unknown.empty()) text += "; none of " + unknown + " has run yet";
    return text + "; to go on: breach extend " + run.id + " --budget " + words::text_of(wanted, 9);
}

}  // namespace

void Store::tell_what_is_missing(Connection& database, std::vector<Run>& runs) {
    for (Run& each : runs) {
        if (each.state != "budget_exhausted") continue;
        each.message = what_is_missing(each, missing_in(database, each.id)) +
                       (each.message.empty() ? "" : "; ") + each.message;
    }
}

}  // namespace breach::orchestrator
