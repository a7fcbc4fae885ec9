// Written by the dispatcher (Attempts), read by requests on other threads: hence the lock.
// Attempts erases an entry when it stops watching. Not in the store, because a commit per line of
// progress would cost more than the phases' own writes.
#include "services/orchestrator/dispatch/progress_board.hpp"

namespace breach::orchestrator {

void ProgressBoard::set(const std::string& task, Progress progress) {
    const std::lock_guard lock(mutex_);
    tasks_[task] = std::move(progress);
}

void ProgressBoard::erase(const std::string& task) {
    const std::lock_guard lock(mutex_);
    tasks_.erase(task);
}

Progress ProgressBoard::of(const std::string& task) const {
    const std::lock_guard lock(mutex_);
    const auto found = tasks_.find(task);
    return found == tasks_.end() ? Progress{} : found->second;
}

double ProgressBoard::sum_of_run(const std::string& run) const {
    const std::lock_guard lock(mutex_);
    double sum = 0.0;
    for (auto each = tasks_.lower_bound(run); each != tasks_.end() && each->first.starts_with(run);
         ++each)
        sum += each->second.fraction;
    return sum;
}

}  // namespace breach::orchestrator
