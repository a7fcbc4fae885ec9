// Used by the store when a trigger fires (add_transfer) and by graph.cpp for times that are known
// at submission, so that both name a transfer alike.
#include "services/orchestrator/records/firing_plan.hpp"

#include "services/orchestrator/records/identity.hpp"

namespace breach::orchestrator {

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

}  // namespace breach::orchestrator
