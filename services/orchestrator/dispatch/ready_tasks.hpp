// Selects the ready tasks to start now: those that fit, without those that the cache or an equal
// task in progress will answer.
#pragma once

#include <set>

#include "services/orchestrator/dispatch/cache.hpp"
#include "services/orchestrator/dispatch/capacity.hpp"
#include "services/orchestrator/dispatch/notifier.hpp"

namespace breach::orchestrator {

class ReadyTasks {
  public:
    /// notifier: notified when the cache has looked a task up.
    ReadyTasks(Store& store, const DataFolder& data, const Notifier& notifier);

    /// In order of priority and age. The first task that does not fit holds back those behind it,
    /// so that small tasks cannot keep a large one waiting permanently.
    std::vector<Task> to_start(Capacity capacity);
    /// Tasks that the cache looked up since the last call and that are no longer ready.
    std::vector<std::string> answered();

  private:
    bool answer_from_cache(const Task& task);
    bool waits_for_an_equal(const Task& task, const std::vector<Task>& chosen) const;

    Store& store_;
    const Notifier& notifier_;
    Mailbox<LookedUp> looked_up_;                 ///< finished look-ups of the cache
    std::set<std::string> in_the_cache_;          ///< tasks that the cache is looking up
    std::map<std::string, LookedUp> not_cached_;  ///< tasks without an earlier result
    std::size_t wait_for_equals_ = 0;             ///< number of tasks, in the last round
    Cache cache_;                                 // last: its thread stops before what it uses
};

}  // namespace breach::orchestrator
