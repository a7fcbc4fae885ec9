// What the end of an attempt means for its task: from the exit record, and from whether the attempt
// resumed from a checkpoint. Attempts::note_exit moves the task by it.
#pragma once

#include <string>

#include "services/orchestrator/executors/order.hpp"

namespace breach::orchestrator {

enum class Ending {
    well,         ///< outputs are there
    badly,        ///< a retry would fail the same way
    retryable,    ///< due to the machine or the moment: killed, out of memory, "try again", or a
                  ///< checkpoint that cannot be resumed
    interrupted,  ///< stopped because the service stops
};

Ending ending_of(const ExitRecord& record, bool resumed);

/// "exit code 70", "killed by signal 9 (Killed)"
std::string in_words(const ExitRecord& record);

}  // namespace breach::orchestrator
