// Maps an exit record to what happens to the task. A breakdown would end the same way again, so
// only transient ends are retried; bad input is one after a resume, when the checkpoint may be at
// fault.
#include "services/orchestrator/dispatch/ending.hpp"

#include <cstring>

#include "core/fault/fault.hpp"

namespace breach::orchestrator {

using fault::ExitCode;

Ending ending_of(const ExitRecord& record, bool resumed) {
    const bool ours = record.stopped == StopReason::shutdown;
    const bool asked = ours || record.stopped == StopReason::signal;
    if (!record.exit_code) return ours ? Ending::interrupted : Ending::retryable;
    switch (static_cast<ExitCode>(*record.exit_code)) {
        case ExitCode::done:
            return Ending::well;
        case ExitCode::try_again:
            return Ending::retryable;
        case ExitCode::interrupted:
        case ExitCode::terminated:  // resumes from the checkpoint at little cost
            return asked ? Ending::interrupted : Ending::retryable;
        case ExitCode::bad_input:
            return resumed ? Ending::retryable : Ending::badly;
        case ExitCode::usage:
        case ExitCode::breakdown:
        case ExitCode::io:
            break;
    }
    return Ending::badly;
}

std::string in_words(const ExitRecord& record) {
    if (record.exit_code) return "exit code " + std::to_string(*record.exit_code);
    if (record.signal)
        return "killed by signal " + std::to_string(*record.signal) + " (" +
               strsignal(*record.signal) + ")";
    return "no exit code";
}

}  // namespace breach::orchestrator
