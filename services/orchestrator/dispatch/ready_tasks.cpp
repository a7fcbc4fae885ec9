// Chooses once per round, on the dispatcher's thread. A task stays `ready` while the cache looks
// it up: in_the_cache_ keeps it from starting, and answered() removes it there. Both collections
// are in memory; after a restart each ready task is looked up once more.
#include "services/orchestrator/dispatch/ready_tasks.hpp"

#include <algorithm>

namespace breach::orchestrator {

ReadyTasks::ReadyTasks(Store& store, const DataFolder& data, const Notifier& notifier)
    : store_(store),
      notifier_(notifier),
      looked_up_(notifier),
      cache_(store, data, [this](LookedUp found) { looked_up_.put(std::move(found)); }) {}

std::vector<Task> ReadyTasks::to_start(Capacity capacity) {
    // Enough to keep the cache's thread busy while all slots are taken.
    constexpr std::size_t look_ahead = 8;  // for the cache, which needs no slot
    std::vector<Task> chosen;
    bool held_back = false;
    const std::size_t most =
        // Tasks that only wait for the cache or for an equal task must not hide those behind
        // them.
        capacity.free_cores() + look_ahead + in_the_cache_.size() + wait_for_equals_;
    wait_for_equals_ = 0;
    for (Task& task : store_.tasks_to_start(capacity.full_phases(), most)) {
        if (answer_from_cache(task)) continue;
        if (held_back || capacity.is_full(task.phase)) continue;
        if (waits_for_an_equal(task, chosen)) {
            ++wait_for_equals_;
            continue;
        }
        if (answer_from_cache(task)) continue;  // an equal task may have just ended
        held_back = !capacity.has_room_for(task);
        if (held_back) continue;
        capacity.take(task);
        not_cached_.erase(task.id);
        chosen.push_back(std::move(task));
    }
    return chosen;
}

bool ReadyTasks::answer_from_cache(const Task& task) {
    if (in_the_cache_.contains(task.id)) return true;
    if (!task.recipe) return false;  // a retried breakdown has no recipe
    const auto looked_up = not_cached_.find(task.id);
    const bool asks = looked_up == not_cached_.end()
                          ? cache_.may_answer(task)
                          : cache_.has_changed_since(looked_up->second, task);
    if (!asks) return false;
    in_the_cache_.insert(task.id);
    cache_.examine(task);
    return true;
}

/// Never computes the same task twice at the same time for different runs or variants.
bool ReadyTasks::waits_for_an_equal(const Task& task, const std::vector<Task>& chosen) const {
    const auto may_be_equal = [&](const Task& other) {
        const bool same_input = other.parent == task.parent && other.input == task.input;
        return task.recipe && other.recipe == task.recipe && (other.run != task.run || same_input);
    };
    if (std::ranges::any_of(chosen, may_be_equal)) {
        notifier_.notify();  // check again once the store knows its start
        return true;
    }
    return store_.equal_in_flight(task).has_value();
}

std::vector<std::string> ReadyTasks::answered() {
    // Still `ready`: there was no answer, and it is not asked again until the number of earlier
    // results changes. Else it was reused, cancelled or removed, and its children must be
    // settled.
    const std::vector<LookedUp> looked_up = looked_up_.take();
    for (const LookedUp& each : looked_up) in_the_cache_.erase(each.task);
    std::vector<std::string> found;
    for (const LookedUp& each : looked_up) {
        const auto now = store_.task(each.task);
        if (now && now->state == TaskState::ready) {
            not_cached_.insert_or_assign(each.task, each);
        } else {
            found.push_back(each.task);
        }
    }
    return found;
}

}  // namespace breach::orchestrator
