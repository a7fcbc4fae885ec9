// What the end of an attempt means for its task. Reads nothing but the exit record and whether the
// attempt went on from a checkpoint.
#pragma once

#include <string>

#include "services/orchestrator/executors/order.hpp"

namespace breach::orchestrator {

enum class Verdict {
    well,         ///< outputs are there
    badly,        ///< the same would happen again
    retryable,    ///< a machine's or a moment's fault: killed, out of memory, "try again", or a
                  ///< checkpoint that cannot be gone on from
    interrupted,  ///< the service stopped it because the service stops
};

Verdict judge(const ExitRecord& record, bool resumed);

/// "exit code 70", "killed by signal 9 (Killed)"
std::string in_words(const ExitRecord& record);

}  // namespace breach::orchestrator
