// The workflow graph of a run: which tasks a study needs and what each waits for.
//
//     fem_solver -- snapshot_<t>.vtkhdf --> transfer_tool -- particles.vtkhdf --> mpm_solver   (for
//     each t_T) lem_tool (on its own)
#pragma once

#include <vector>

#include "services/orchestrator/study.hpp"

namespace breach::orchestrator {

/// Tasks in the order in which slots are given; parents come before their children.
std::vector<TaskPlan> plan_tasks(const Study& study);

/// "snapshot_0.500000.vtkhdf"
std::string snapshot_name(double time);

}  // namespace breach::orchestrator
