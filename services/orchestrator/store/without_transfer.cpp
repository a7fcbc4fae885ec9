// Variants without a transfer: the FEM ended and no trigger fired. They have no row among the
// results, so the results would omit them silently.
#include <map>
#include <set>

#include "core/phases/phases.hpp"
#include "core/words/number.hpp"
#include "services/orchestrator/records/firing_plan.hpp"
#include "services/orchestrator/store/store.hpp"
#include "services/orchestrator/store/views.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

/// An ended FEM, and the outcome of its triggers.
struct EndedFem {
    std::string task;
    std::string state;
    std::string reason;
    bool came_through;  ///< neither failed nor cancelled
    bool stood;
    std::size_t open_triggers = 0;
    std::size_t triggers = 0;
};

/// By label. For a failed FEM its fault counts, not its triggers' reasons.
std::map<std::string, EndedFem> ended_fems(Connection& database, const std::string& run) {
    std::map<std::string, EndedFem> found;
    std::map<std::string, EndedFem*> by_task;
    database.query(
        R"(SELECT id, label, state, coalesce(fault_summary, '') AS reason,
    coalesce(json_extract(result, '$.ended'), '') = 'entangled' AS entangled,
    json_extract(result, '$.end_time') AS end_time FROM tasks WHERE run=? AND phase=?)",
        {run, phases::fem.program}, [&](const Row& row) {
            const TaskState state = task_state_named(row.text("state"));
            if (!is_final(state)) return;
            const bool entangled = row.yes("entangled");
            EndedFem& fem = found[row.text("label")];
            fem = {row.text("id"), std::string(name_of(state)), row.text("reason"),
                   has_output(state), !entangled};
            if (entangled)
                fem.reason =
                    "the FEM's mesh entangled at " + words::text_of(row.real("end_time"), 4) + " s";
            by_task[fem.task] = &fem;
        });
    database.query(
        R"(SELECT fem_task, name, state, reason, coalesce(json_extract(result, '$.was_met'), 1) AS was_met
FROM triggers WHERE run=? ORDER BY rowid)",
        {run}, [&](const Row& row) {
            const auto of = by_task.find(row.text("fem_task"));
            if (of == by_task.end() || !of->second->came_through) return;
            EndedFem& fem = *of->second;
            const TriggerState state = trigger_state_named(row.text("state"));
            ++fem.triggers;
            if (!is_final(state)) ++fem.open_triggers;
            fem.state = state == TriggerState::disarmed ? "cancelled" : "not_reached";
            fem.stood = fem.stood && state == TriggerState::expired && !row.yes("was_met");
            fem.reason +=
                (fem.reason.empty() ? "" : "; ") + row.text("name") + ": " + row.text("reason");
        });
    return found;
}

bool may_get_transfers(const EndedFem& fem) {
    return fem.came_through && (fem.triggers == 0 || fem.open_triggers > 0);
}

const std::string& label_of_fem(const std::vector<TaskPlan>& plan, const TaskPlan& task) {
    const TaskPlan* at = &task;
    while (at->parent) at = &plan[*at->parent];
    return at->label;
}

}  // namespace

std::vector<WithoutTransfer> variants_without_transfer(Connection& database,
                                                       const std::string& run) {
    std::vector<WithoutTransfer> found;
    if (!database.finds("SELECT 1 FROM triggers WHERE run=? LIMIT 1", {run})) return found;
    const std::vector<TaskPlan> plan = firing_plan_of(database, run);
    const auto fems = ended_fems(database, run);
    const std::vector<std::string> named = database.texts(
        "SELECT DISTINCT variant FROM tasks WHERE run=? AND phase=?", {run, phases::mpm.program});
    const std::set<std::string> with_rows(named.begin(), named.end());
    for (const TaskPlan& each : plan) {
        if (each.phase != phases::mpm.program || with_rows.contains(each.variant)) continue;
        const auto fem = fems.find(label_of_fem(plan, each));
        if (fem == fems.end() || may_get_transfers(fem->second)) continue;
        found.push_back({each.variant, fem->second.task, fem->second.state,
                         fem->second.came_through && fem->second.stood, fem->second.reason});
    }
    return found;
}

std::vector<WithoutTransfer> Store::without_transfer(const std::string& run) const {
    return variants_without_transfer(*reader(), run);
}

}  // namespace breach::orchestrator
