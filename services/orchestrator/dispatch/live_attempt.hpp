// An attempt that may have a process: the order that starts it, and the fault to be stored.
#pragma once

#include "services/orchestrator/dispatch/capacity.hpp"
#include "services/orchestrator/executors/order.hpp"
#include "services/orchestrator/files/data_folder.hpp"
#include "services/orchestrator/store/store.hpp"

namespace breach::orchestrator {

/// Memory of the dispatcher about one attempt. Attempts::start or adopt creates it, observe sets
/// the flags as the rows follow the process, note_exit or note_loss sets `over`, and the end of
/// the round removes it with its two watches. Nothing in it is needed after a restart.
struct LiveAttempt {
    Task task;
    std::int64_t number;
    AttemptFolder folder;
    bool resumes;  ///< continues from the checkpoint of an earlier attempt, if there is one
    int attempt_watch;
    int output_watch;
    std::streamoff lines_read = 0;
    bool submission_noted = false;  ///< the attempt's row says that the executor took it
    bool start_noted = false;       ///< the task's row says that it has a process
    /// The attempt's row is `running`: the phase wrote a first line.
    bool begun = false;
    bool outputs_changed = true;  ///< a new file may release a child
    bool asked_to_stop = false;
    bool over = false;
};

/// A refused checkpoint (damaged, or of another version) is not tried twice.
bool may_resume(const Store& store, const std::string& task, std::int64_t number);

/// Writes the run's scene, and beside it links to the uploaded files that it names.
void lay_out_scene(const Store& store, const DataFolder& data, const std::string& run);

Order order_for(const LiveAttempt& live, const Store& store, const DataFolder& data,
                const DispatchSettings& settings);

/// The fault that the phase reports (fault.json), else the last line of its log.
TaskFault fault_of(const LiveAttempt& live, const ExitRecord& record, const DataFolder& data);

}  // namespace breach::orchestrator
