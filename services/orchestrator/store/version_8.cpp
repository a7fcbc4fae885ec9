#include "services/orchestrator/store/versions.hpp"

namespace breach::orchestrator {

// Every table of results looks for accuracy studies of equal scenes.
const char* const version_8 = R"sql(
CREATE INDEX runs_with_accuracy ON runs(id) WHERE json_type(study, '$.accuracy')='object';
)sql";

}  // namespace breach::orchestrator
