// What the end of an attempt means for its task. Reads nothing but the exit record.
#pragma once

#include <string>

#include "services/orchestrator/executors/order.hpp"

namespace breach::orchestrator {

enum class Verdict {
    well,         ///< outputs are there
    badly,        ///< the same would happen again
    retryable,    ///< a machine's or a moment's fault: killed, out of memory, "try again"
    interrupted,  ///< the service stopped it because the service stops
};

Verdict judge(const ExitRecord& record);

/// "exit code 70", "killed by signal 9 (Killed)"
std::string in_words(const ExitRecord& record);

}  // namespace breach::orchestrator
