// Invariants of a service's store and files after any kill.
#pragma once

#include "services/orchestrator/store/store.hpp"
#include "tests/faults/service_under_test.hpp"

namespace breach::testing {

/// `breachline check` of a stopped service, its outputs read whole; every finding is a failure of the running test: a
/// move that the lifecycle does not allow, two live attempts of one task, a success stored twice, a state that is not
/// the last event's, wrong counts of tasks, an artifact with another hash, a stray folder.
void expect_sound_history(const Sandbox& sandbox);

}  // namespace breach::testing
