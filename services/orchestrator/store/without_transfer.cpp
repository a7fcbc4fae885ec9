// Variants that nothing was transferred of: their FEM ended and its triggers came to nothing, so that
// they have no row among the results, and would be missing there without a word.
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

/// A FEM that has ended, and what its triggers came to.
struct EndedFem {
    std::string task;
    std::string state;
    std::string reason;
    bool came_through;  ///< it did not fail, and was not cancelled
    bool stood;
    std::size_t open_triggers = 0;
    std::size_t triggers = 0;
};

/// By label. The triggers of one that failed say nothing beside its fault.
std::map<std::string, EndedFem> ended_fems(Connection& database, const std::string& run) {
    std::map<std::string, EndedFem> found;
    std::map<std::string, EndedFem*> by_task;
    database.query(
        "SELECT id, label, state, coalesce(fault_summary, ''), coalesce(json_extract(result, "
        "'$.ended'), ''), json_extract(result, '$.end_time') FROM tasks WHERE run=? AND phase=?",
        {run, phases::fem.program}, [&](const Row& row) {
            const TaskState state = task_state_named(row.text(2));
            if (!is_final(state)) return;
            const bool entangled = row.text(4) == "entangled";
            EndedFem& fem = found[row.text(1)];
            fem = {row.text(0), std::string(name_of(state)), row.text(3), has_output(state),
                   !entangled};
            if (entangled)
                fem.reason = "the FEM's mesh entangled at " + words::text_of(row.real(5), 4) + " s";
            by_task[row.text(0)] = &fem;
        });
    database.query(
        "SELECT fem_task, name, state, reason, coalesce(json_extract(result, '$.was_met'), 1) FROM "
        "triggers WHERE run=? AND NOT (" +
            draws_samples("spec") + ") ORDER BY rowid",
        {run}, [&](const Row& row) {
            const auto of = by_task.find(row.text(0));
            if (of == by_task.end() || !of->second->came_through) return;
            EndedFem& fem = *of->second;
            const TriggerState state = trigger_state_named(row.text(2));
            ++fem.triggers;
            if (!is_final(state)) ++fem.open_triggers;
            fem.state = state == TriggerState::disarmed ? "cancelled" : "not_reached";
            fem.stood = fem.stood && state == TriggerState::expired && row.integer(4) == 0;
            fem.reason += (fem.reason.empty() ? "" : "; ") + row.text(1) + ": " + row.text(3);
        });
    return found;
}

bool may_get_transfers(const EndedFem& fem) {
    return fem.came_through && (fem.triggers == 0 || fem.open_triggers > 0);
}

/// Of one task of the plan.
const std::string& label_of_fem(const std::vector<TaskPlan>& plan, const TaskPlan& task) {
    const TaskPlan* at = &task;
    while (at->parent) at = &plan[*at->parent];
    return at->label;
}

std::set<std::string> variants_with_rows(Connection& database, const std::string& run) {
    std::set<std::string> found;
    database.query("SELECT DISTINCT variant FROM tasks WHERE run=? AND phase=?",
                   {run, phases::mpm.program}, [&](const Row& row) { found.insert(row.text(0)); });
    return found;
}

}  // namespace

std::vector<WithoutTransfer> variants_without_transfer(Connection& database,
                                                       const std::string& run) {
    std::vector<WithoutTransfer> found;
    bool has_triggers = false;
    database.query("SELECT 1 FROM triggers WHERE run=? LIMIT 1", {run},
                   [&](const Row&) { has_triggers = true; });
    if (!has_triggers) return found;
    std::vector<TaskPlan> plan;
    database.query("SELECT tasks FROM firing_plans WHERE run=?", {run},
                   [&](const Row& row) { plan = read_firing_plan(json::parse(row.text(0))); });
    const auto fems = ended_fems(database, run);
    const auto with_rows = variants_with_rows(database, run);
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
    std::vector<WithoutTransfer> found;
    read([&](Connection& database) { found = variants_without_transfer(database, run); });
    return found;
}

}  // namespace breach::orchestrator
