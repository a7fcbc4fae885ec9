// The tasks of one more transfer, for every variant: planned with the run, stored beside it, and
// added to it when a trigger fires. Their transfer time is open until then. The list includes their
// FEMs, so that a parent is an index into it.
#pragma once

#include "services/orchestrator/records/records.hpp"

namespace breach::orchestrator {

/// The task with its time filled in, also in its label and the name of its snapshot.
TaskPlan at_time(TaskPlan open, double time);

/// Index of the task for this FEM of the run. A FEM that is run again for more transfer times has
/// another label ("fem_2") and is found by its variant. Nothing: there is none.
std::optional<std::size_t> place_of_fem(const std::vector<TaskPlan>& plan, const std::string& label,
                                        const std::string& variant);

}  // namespace breach::orchestrator
