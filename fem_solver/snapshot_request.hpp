// Snapshots on demand: whoever watches the analysis puts a file `snapshot_request` into the output
// folder (made elsewhere, renamed into place; what it holds does not matter). The analysis takes it
// at the end of the step that is going on, writes its snapshot, and removes it. Costs one system
// call per step.
#pragma once

#include <filesystem>

namespace breach::fem {

/// True when there is a request; it is taken by renaming it to snapshot_request.taken.
bool request_is_taken(const std::filesystem::path& output);

/// The snapshot exists: removes what was taken. A request that came meanwhile stays. An analysis
/// that is killed in between has not answered: whoever still wants a snapshot asks again.
void answer_request(const std::filesystem::path& output);

}  // namespace breach::fem
