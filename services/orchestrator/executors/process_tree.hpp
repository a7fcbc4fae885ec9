// The processes of this machine as /proc shows them: who descends from us, who carries an attempt's
// mark.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace breach::orchestrator {

/// All living descendants of `root`, without `root` itself.
std::vector<pid_t> descendants(pid_t root);

/// Processes whose environment says that they were started for this attempt, wherever they hang in
/// the tree.
std::vector<pid_t> marked_processes(const std::string& attempt);

}  // namespace breach::orchestrator
