// What must be true of a service's memory and of its files, whatever was killed when.
#pragma once

#include "services/orchestrator/store/store.hpp"
#include "tests/faults/service_under_test.hpp"

namespace breach::testing {

/// `breachline check` of a service that has stopped, its outputs read whole; every finding is a failure of the running
/// test: a move that the lifecycle does not allow, two live attempts of one task, a success told twice, a state that is
/// not the last event's, counts that are not those of the tasks, an artifact whose hash is not its own, a stray folder.
void expect_sound_history(const Sandbox& sandbox);

}  // namespace breach::testing
