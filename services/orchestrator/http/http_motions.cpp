// Gathers what findings/motions.cpp needs of a run: one entry per FEM, with the measures of its
// record and the farthest of its runouts.
#include <map>

#include "core/motion/measures.hpp"
#include "core/phases/phases.hpp"
#include "services/findings/motions.hpp"
#include "services/orchestrator/http/answers.hpp"
#include "services/orchestrator/http/http_routes.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

/// Nothing: the FEM has not ended, or has no motion.
std::optional<findings::Shaken> shaken_by(const Task& fem) {
    if (!has_output(fem.state) || !fem.result) return std::nullopt;
    const json& result = *fem.result;
    const json input = result.value("/motions/input"_json_pointer, json());
    if (!input.is_object()) return std::nullopt;
    findings::Shaken found{.variant = fem.variant,
                           .measures = {},
                           .liquefaction_depth = result.value("largest_liquefaction_depth", 0.0)};
    for (const motion::NamedMeasure& each : motion::named_measures)
        found.measures.push_back(input.at(each.name));
    return found;
}

std::vector<findings::Shaken> shaken_in(const Store& store, const std::string& run) {
    std::map<std::string, Task> tasks;
    for (Task& each : store.tasks_of(run)) tasks.emplace(each.id, std::move(each));
    std::map<std::string, findings::Shaken> by_fem;
    for (const auto& [id, task] : tasks)
        if (task.phase == phases::fem.program)
            if (auto found = shaken_by(task)) by_fem.emplace(id, std::move(*found));
    for (const ResultRow& row : store.results(run)) {
        const json& runout = value_of(row, "runout_beyond_toe");
        const json& made_by = value_of(row, "transfer_task");
        const auto transfer = made_by.is_string() ? tasks.find(made_by) : tasks.end();
        if (!runout.is_number() || transfer == tasks.end()) continue;
        const auto fem = by_fem.find(transfer->second.parent.value_or(""));
        // Several transfer times of one FEM: the largest runout counts. An absent one is less than
        // any.
        if (fem == by_fem.end() || fem->second.runout >= runout.get<double>()) continue;
        fem->second.runout = runout;
        fem->second.lower_bound = value_of(row, "lower_bound") == true;
    }
    for (const WithoutTransfer& each : store.without_transfer(run))
        if (const auto fem = by_fem.find(each.fem_task); fem != by_fem.end() && each.stood)
            // A dam that stood is a result, 0 m; a FEM whose transfer failed has none.
            fem->second.runout = fem->second.runout.value_or(0.0);
    std::vector<findings::Shaken> all;
    for (auto& [_, each] : by_fem) all.push_back(std::move(each));
    // Task ids say nothing to a reader.
    std::ranges::sort(all, {}, &findings::Shaken::variant);
    return all;
}

/// Findings of a study of several motions so far.
void motions(const Service& service, Call& call) {
    call.allow_parameters({});
    const Run run = wanted_run(service, call.parts[0]);
    const auto shaken = shaken_in(service.store, run.id);
    if (shaken.size() < findings::fewest_motions)
        throw not_found("study of motions in run " + run.id + ": " + std::to_string(shaken.size()) +
                        " of its FEMs have ended under a motion, " +
                        std::to_string(findings::fewest_motions) + " are needed");
    json found = findings::motions_of(shaken);
    found["run"] = run.id;
    reply(call.response, found);
}

}  // namespace

void add_motion_routes(Router& router, Service& service) {
    router.get("/v1/runs/{id}/motions", [&](Call& call) { motions(service, call); });
}

}  // namespace breach::orchestrator
