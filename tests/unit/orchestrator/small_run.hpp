// The smallest run of the whole chain, for tests that store and serve runs.
#pragma once

#include "services/orchestrator/records/identity.hpp"
#include "services/orchestrator/records/records.hpp"

namespace breach::orchestrator {

/// A FEM, one transfer and one MPM.
inline NewRun small_run() {
    return {.id = new_run_id(),
            .name = "small",
            .title = "",
            .study = "{}",
            .scene = "{}",
            .tasks = {{.phase = "fem_solver",
                       .label = "fem",
                       .transfer_time = {},
                       .parent = {},
                       .release = Release::at_once,
                       .input = "",
                       .overrides = {"/a=1"}},
                      {.phase = "transfer_tool",
                       .label = "transfer_0.500000",
                       .transfer_time = 0.5,
                       .parent = 0,
                       .release = Release::file_exists,
                       .input = "snapshot_0.500000.vtkhdf",
                       .overrides = {}},
                      {.phase = "mpm_solver",
                       .label = "mpm_0.500000",
                       .transfer_time = 0.5,
                       .parent = 1,
                       .release = Release::parent_succeeded,
                       .input = "particles.vtkhdf",
                       .overrides = {}}}};
}

}  // namespace breach::orchestrator
