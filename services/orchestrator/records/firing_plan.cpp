#include "services/orchestrator/records/firing_plan.hpp"

#include "core/phases/phases.hpp"
#include "services/orchestrator/records/identity.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

/// Version 0.1.0: without the FEMs, parents by label, a time of -1 in labels and inputs.
std::vector<TaskPlan> from_labels(const json& rows) {
    std::vector<TaskPlan> plan;
    std::map<std::string, std::size_t> places;
    for (json row : rows) {
        const std::string parent = row.at("parent");
        if (!places.contains(parent)) {
            places[parent] = plan.size();
            plan.push_back({.phase = phases::fem.program,
                            .label = parent,
                            .transfer_time = {},
                            .parent = {},
                            .release = Release::at_once,
                            .input = {},
                            .overrides = {}});
        }
        places[row.at("label")] = plan.size();
        row["parent"] = places.at(parent);
        row["transfer_time"] = nullptr;
        plan.push_back(row.get<TaskPlan>());
    }
    return plan;
}

}  // namespace

TaskPlan at_time(TaskPlan open, double time) {
    open.transfer_time = time;
    open.label = label_of(open);
    if (open.release == Release::file_exists) open.input = snapshot_name(time);
    return open;
}

std::optional<std::size_t> place_of_fem(const std::vector<TaskPlan>& plan, const std::string& label,
                                        const std::string& variant) {
    std::optional<std::size_t> of_variant;
    for (std::size_t i = 0; i < plan.size(); ++i) {
        if (plan[i].parent) continue;
        if (plan[i].label == label) return i;
        if (!of_variant && plan[i].variant == variant) of_variant = i;
    }
    return of_variant;
}

std::vector<TaskPlan> read_firing_plan(const json& document) {
    const bool by_label = !document.empty() && document[0].at("parent").is_string();
    return by_label ? from_labels(document) : document.get<std::vector<TaskPlan>>();
}

}  // namespace breach::orchestrator
