// Snapshots on demand. A program puts a file `snapshot_request` into the output folder (written
// elsewhere and renamed; any content). At the end of the step the analysis takes the request,
// writes a snapshot and removes it. Costs one system call per step.
// The service's triggers use it: they look at telemetry and want a state that no one could plan.
#pragma once

#include <filesystem>

namespace breach::fem {

/// True if there is a request; renames it to snapshot_request.taken.
bool request_is_taken(const std::filesystem::path& output);

/// Call after the snapshot is written: removes the taken request, but no newer one. If the analysis
/// is killed in between, the request must be repeated.
void answer_request(const std::filesystem::path& output);

}  // namespace breach::fem
