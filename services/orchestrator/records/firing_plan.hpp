// The tasks that one more transfer needs, for every variant: planned with the run, kept beside it,
// and added to it when a trigger fires. Their transfer time is open until then. The FEMs that they
// come from stand in the list as well, so that parents are places in it.
#pragma once

#include "services/orchestrator/records/records.hpp"

namespace breach::orchestrator {

/// The task with its time put in, and what is named after that: its label, its snapshot.
TaskPlan at_time(TaskPlan open, double time);

/// Place of the task that stands for this FEM of the run. One computed again for more transfer times
/// has a label of its own ("fem_2") and goes by its variant. Nothing: none does.
std::optional<std::size_t> place_of_fem(const std::vector<TaskPlan>& plan, const std::string& label,
                                        const std::string& variant);

}  // namespace breach::orchestrator
