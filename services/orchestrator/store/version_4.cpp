#include "services/orchestrator/store/versions.hpp"

namespace breach::orchestrator {

// Thousands of blocked tasks of one parent, and tables of thousands of points, are read by index.
const char* const version_4 = R"sql(
DROP INDEX tasks_by_parent;
CREATE INDEX tasks_by_parent ON tasks(parent, state, id);
CREATE INDEX tasks_of_sweep ON tasks(run, phase, variant, transfer_time);
CREATE INDEX events_of_run ON events(run, seq);
)sql";

}  // namespace breach::orchestrator
