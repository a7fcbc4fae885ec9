// The cache: a ready task takes the result of an equal earlier task instead of running. Equal tasks
// have the same recipe and the same SHA-256 of the input file. The result is the output of a task
// that succeeded (including a FEM whose mesh entangled), or its breakdown (exit code 70). Every
// file is hashed again before reuse; if one is missing or altered, the task runs. A separate thread
// searches and hashes.
#pragma once

#include <functional>

#include "services/orchestrator/dispatch/task_queue.hpp"
#include "services/orchestrator/files/data_folder.hpp"
#include "services/orchestrator/store/store.hpp"

namespace breach::orchestrator {

/// Removes files of a result that was placed but not taken because the service was killed in
/// between: a task must not write into them, as they may be links to another run's.
void drop_placed_outputs(const DataFolder& data, const Task& task);

struct LookedUp {
    std::string task;
    std::string input_sha256;
    std::size_t answers = 0;  ///< including damaged ones
};

class Cache {
  public:
    /// `examined` is called on the cache's thread with each task that was looked up; its state says
    /// whether it was answered.
    Cache(Store& store, const DataFolder& data, std::function<void(LookedUp)> examined);

    /// Fast: false when no earlier task can have the result, so that hashing the input is not worth
    /// while.
    bool may_answer(const Task& task) const;
    /// Fast: whether the number of earlier results differs from that of the look-up.
    bool has_changed_since(const LookedUp& earlier, const Task& task) const;
    void examine(Task task);

  private:
    void serve(const Task& task);
    void look_up(const Task& task, LookedUp& found);
    /// Why the outputs of `earlier` cannot be used; nothing when they can.
    std::optional<std::string> damage_to(const Task& earlier) const;
    /// False: `earlier` or the task has changed; no file of it is left.
    bool take(const Task& earlier, const Task& task) const;
    void place_outputs(const Task& earlier, const Task& task) const;

    Store& store_;
    const DataFolder& data_;
    std::function<void(LookedUp)> examined_;
    TaskQueue queue_;  // last: its thread stops before the members it uses are destroyed
};

}  // namespace breach::orchestrator
