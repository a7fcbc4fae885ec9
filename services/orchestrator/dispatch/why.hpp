// "Why did it run (again)?": the differences of a task from the most similar earlier one.
#pragma once

#include "services/orchestrator/store/store.hpp"

namespace breach::orchestrator {

/// {"reason":"scene part changed","differs":["/mpm/cfl"],"compared_with":"<task>"}. Reasons:
///
///     has not run                    it waits, or will never run
///     waits for an equal task        that is being computed for another run
///     taken from an earlier task     it did not run; compared_with is the earlier task
///     reuse is switched off          by the study, or the result depends on more than the scene
///     first of its kind              no earlier task of this phase; compared_with is null
///     scene part changed             differs: pointers into the scene
///     cache version changed          the phase's numerics are newer
///     input changed                  same scene part, another input file
///     earlier task did not succeed   it failed, was stopped or skipped
///     earlier task had not ended     both were under way at the same time
///     stored outputs are damaged     detail: which file
nlohmann::json why_it_ran(const Store& store, const Task& task);

}  // namespace breach::orchestrator
