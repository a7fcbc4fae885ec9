#include "services/orchestrator/store/versions.hpp"

namespace breach::orchestrator {

// A breakdown (exit code 70) follows from the question as a result does.
const char* const version_5 = R"sql(
DROP INDEX tasks_by_recipe;
CREATE INDEX tasks_by_recipe ON tasks(recipe, input_sha256, id)
    WHERE state = 'succeeded' OR (state = 'failed' AND fault_exit = 70);
)sql";

}  // namespace breach::orchestrator
