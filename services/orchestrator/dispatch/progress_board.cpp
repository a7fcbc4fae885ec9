// Written by the dispatcher (Attempts), read by requests on other threads: hence the lock.
// Attempts erases an entry when it stops watching. Not in the store, because a commit per line of
// progress would cost more than the phases' own writes.
#include "services/orchestrator/dispatch/progress_board.hpp"

#include <algorithm>

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

double ProgressBoard::never_back(const std::string& run, double progress) const {
    const std::lock_guard lock(mutex_);
    if (progress >= 1.0) {
        largest_.erase(run);
        return progress;
    }
    double& largest = largest_[run];
    return largest = std::max(largest, progress);
}

}  // namespace breach::orchestrator
