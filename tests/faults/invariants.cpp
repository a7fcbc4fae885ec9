#include "tests/faults/invariants.hpp"

#include <gtest/gtest.h>

#include "services/orchestrator/audit/audit.hpp"

namespace breach::testing {

using namespace orchestrator;

void expect_sound_history(const Sandbox& sandbox) {
    const Audit audit = audited(DataPaths(sandbox.data()), Look::at_contents);
    EXPECT_GT(audit.events, 0);
    for (const Inconsistency& each : audit.inconsistencies)
        ADD_FAILURE() << each.part << ": " << each.where << ": " << each.cause;
}

}  // namespace breach::testing
