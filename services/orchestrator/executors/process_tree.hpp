// Processes of this machine from /proc: our descendants, and those with an attempt's mark.
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
/// Zeros if it has ended.
Usage usage_of(pid_t pid);

std::string host_name();

/// Kills every process except ourselves with the mark of this attempt in its environment, anywhere
/// in the tree; also those that are forked meanwhile.
void kill_marked_processes(const std::string& attempt);

}  // namespace breach::orchestrator
