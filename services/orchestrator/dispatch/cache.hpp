// The cache: a ready task whose question was answered before takes that answer instead of running.
// The question is the task's recipe and the SHA-256 of its input file; the answer is the output of
// a task that succeeded (a FEM whose mesh entangled did), or that broke down (exit code 70) as this one would. Every file of the
// answer is hashed again before it is served: one that is missing or altered is refused, and the
// task runs. The looking and hashing has a thread of its own.
#pragma once

#include <functional>

#include "services/orchestrator/dispatch/task_queue.hpp"
#include "services/orchestrator/files/data_folder.hpp"
#include "services/orchestrator/store/store.hpp"

namespace breach::orchestrator {

/// A task about to run must not find, and write into, the files of an answer that was placed and not
/// taken because the service was killed in between: they may be links to another run's.
void drop_placed_outputs(const DataFolder& data, const Task& task);

/// Of one look-up: what there was to answer the task with.
struct LookedUp {
    std::string task;
    std::string input_sha256;
    std::size_t answers = 0;  ///< damaged ones counted
};

class Cache {
  public:
    /// `examined` is called on the cache's thread with each task that was looked up; its state says
    /// whether it was answered.
    Cache(Store& store, const DataFolder& data, std::function<void(LookedUp)> examined);

    /// Quick: false when no earlier task can have the answer, so that hashing the input is not
    /// worth while.
    bool may_answer(const Task& task) const;
    /// Quick: whether there is another number of answers than the look-up found.
    bool has_changed_since(const LookedUp& earlier, const Task& task) const;
    void examine(Task task);

  private:
    void serve(const Task& task);
    void look_up(const Task& task, LookedUp& found);
    /// Why the outputs of `earlier` cannot be used; nothing when they can.
    std::optional<std::string> damage_to(const Task& earlier) const;
    /// False: `earlier` or the task is not what it was any more; nothing of it is left.
    bool take(const Task& earlier, const Task& task) const;
    void place_outputs(const Task& earlier, const Task& task) const;

    Store& store_;
    const DataFolder& data_;
    std::function<void(LookedUp)> examined_;
    TaskQueue queue_;  // last: its thread stops before what it uses goes
};

}  // namespace breach::orchestrator
