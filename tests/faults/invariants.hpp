// Invariants of a service's store and files, also after a kill.
#pragma once

#include "services/orchestrator/store/store.hpp"
#include "tests/faults/service_under_test.hpp"

namespace breach::testing {

/// Runs `breachline check` on a stopped service, whose outputs are read whole. Every finding fails
/// the test: an invalid lifecycle transition, two live attempts of a task, a success stored twice,
/// a state that differs from the last event, wrong task counts, an artifact with another hash, a
/// stray folder.
void expect_sound_history(const Sandbox& sandbox);

}  // namespace breach::testing
