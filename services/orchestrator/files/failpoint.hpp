// Named points at which a test may kill or disturb this process: before and after every write of a
// state, and between the steps of an operation.
//
//     BREACHLINE_FAILPOINT=name[:n[:file]]   kill -9 when `name` is reached for the n-th time
//     BREACHLINE_TROUBLE=name[:n[:file]]     throws IoError there, as a full disk would
//     BREACHLINE_HOLD=name[:n[:file]]        waits there for as long as `file` exists
//
// With a file, the first two happen only once, in the process that can remove the file. Without the
// variables nothing happens. Unknown names do not compile.
#pragma once

#include <algorithm>
#include <string_view>

namespace breach::orchestrator {

inline constexpr std::string_view failpoint_names[]{
    "store_before_commit",
    "store_after_commit",
    "claim_before",    ///< a task is to be started, nothing is stored
    "claim_after",     ///< its attempt's row is stored, nothing is started
    "start_after",     ///< its process is started, which is not stored
    "exit_before",     ///< its exit record was read, nothing is stored
    "exit_after",      ///< its end is stored, its outputs are not registered
    "outputs_before",  ///< its outputs are hashed, nothing is stored
    "outputs_after",   ///< they are stored, no reader is notified
    "firing_before",   ///< a trigger was met, nothing is stored
    "firing_after",    ///< the firing is stored
    "supervisor_before_phase",
    "supervisor_after_phase",   ///< the phase has ended, there is no record
    "supervisor_after_record",  ///< there is
    "sbatch_before",            ///< the job's name is noted, sbatch is not called
    "sbatch_after",             ///< it has answered, which is not noted
    "reuse_placed",             ///< the cache's files are in the task's folder, which is not stored
    "reuse_none",               ///< the cache found no answer, which is not reported yet
    "removal_rows_gone",        ///< a run's rows are gone, its files are there
    "removal_half_way",         ///< some of its files are gone
    "removal_files_gone",       ///< all are, which is not noted
    "upload_before",            ///< a file that was sent is on the disk under a temporary name
    "upload_after",             ///< it has its name, which is not committed
};

/// One of these names.
struct Failpoint {
    consteval Failpoint(const char* given) : name(given) {
        if (std::ranges::find(failpoint_names, name) == std::end(failpoint_names))
            throw "no such failpoint";
    }
    std::string_view name;
};

void pass_failpoint(Failpoint point);

}  // namespace breach::orchestrator
