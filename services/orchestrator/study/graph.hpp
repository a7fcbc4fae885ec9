// The workflow graph of a run: which tasks a study needs and what each waits for.
//
//     fem_solver -- snapshot_<t>.vtkhdf --> transfer_tool -- particles.vtkhdf --> mpm_solver
//                                                  (for each variant and each t_T)
//     fem_solver -- all snapshots --> post_seismic (with "post_seismic": once for each variant)
//     lem_tool                                     (for each variant, on its own)
//
// A scene without a FEM is static: its material points fill the section, and mpm_solver and
// lem_tool run once per variant without waiting. A scene with neither FEM nor MPM has lem_tool
// alone. An accuracy study may need only one phase (study/accuracy.hpp).
//
// Equal tasks of different variants (recipe, parent, input) are one task, so variants that change
// only /mpm share the FEM and all transfers. Where a trigger uses the critical depth, only variants
// with equal stability analyses share a FEM: with another depth the trigger fires at another time.
#pragma once

#include <string_view>
#include <vector>

#include "services/orchestrator/records/trigger.hpp"
#include "services/orchestrator/study/study.hpp"
#include "services/orchestrator/study/transfers.hpp"

namespace breach::orchestrator {

struct TaskGraph {
    std::vector<TaskPlan> tasks;  ///< in the order in which slots are given; parents come first
    std::vector<Recipe> recipes;  ///< of all tasks, each once
    std::vector<TaskPlan> one_more_transfer;  ///< for every variant (records/firing_plan.hpp)
};

/// Such a trigger waits for the phase that gives the number.
bool asks_for(const Work& work, const StabilityField& field);

TaskGraph plan_tasks(const Study& study, const Numerics& numerics);

}  // namespace breach::orchestrator
