// The processes of this machine as /proc shows them: who descends from us, who carries an attempt's
// mark.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <string>
#include <vector>

namespace breach::orchestrator {

/// All living descendants of `root`, without `root` itself.
std::vector<pid_t> descendants(pid_t root);

struct Usage {
    double cpu_seconds = 0.0;    ///< of all its threads, without its children
    std::int64_t memory_mb = 0;  ///< resident [1e6 bytes]
};
/// Zeros when it is gone.
Usage usage_of(pid_t pid);

std::string host_name();

/// Kills every process but ourselves whose environment says that it was started for this attempt,
/// wherever it hangs in the tree; also those that were forked meanwhile.
void kill_marked_processes(const std::string& attempt);

}  // namespace breach::orchestrator
