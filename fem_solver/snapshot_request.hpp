// Snapshots on demand: a program that watches the analysis puts a file `snapshot_request` into
// the output folder (made elsewhere, renamed into place; any content). The analysis takes it at
// the end of the current step, writes its snapshot, and removes it. Costs one system call per
// step.
#pragma once

#include <filesystem>

namespace breach::fem {

/// True when there is a request; it is taken by renaming it to snapshot_request.taken.
bool request_is_taken(const std::filesystem::path& output);

/// Call when the snapshot exists: removes the taken request. A newer request stays. If the analysis
/// is killed in between, the request is unanswered and must be repeated.
void answer_request(const std::filesystem::path& output);

}  // namespace breach::fem
