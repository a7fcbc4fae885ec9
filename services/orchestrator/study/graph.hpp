// The workflow graph of a run: which tasks a study needs and what each waits for.
//
//     fem_solver -- snapshot_<t>.vtkhdf --> transfer_tool -- particles.vtkhdf --> mpm_solver
//                                                  (for each variant and each t_T)
//     lem_tool                                     (for each variant, on its own)
//
// Tasks of different variants are one task when they are the same: equal recipe, equal parent,
// equal input. A variant that changes only /mpm thus shares the FEM and all transfers.
#pragma once

#include <vector>

#include "services/orchestrator/study/study.hpp"

namespace breach::orchestrator {

struct TaskGraph {
    std::vector<TaskPlan> tasks;  ///< in the order in which slots are given; parents come first
    std::vector<Recipe> recipes;  ///< of all tasks, each once
};

TaskGraph plan_tasks(const Study& study);

/// The tasks of one more transfer, for every variant, with the time left open (open_time_text
/// stands for it in labels and inputs) and parents by label: JSON, kept with the run until a
/// trigger fires.
std::string firing_plan(const Study& study);

/// "snapshot_0.500000.vtkhdf"
std::string snapshot_name(double time);

}  // namespace breach::orchestrator
