// A thread with a queue, for the cache and the registrar. The queue is not stored: both can find
// their work again in the store after a restart.
#include "services/orchestrator/dispatch/task_queue.hpp"

namespace breach::orchestrator {

TaskQueue::TaskQueue(std::function<Handled(const Task&)> handle) : handle_(std::move(handle)) {
    thread_ = std::jthread([this](const std::stop_token& stop) { serve(stop); });
}

void TaskQueue::add(Task task) {
    {
        const std::lock_guard lock(mutex_);
        waiting_.push_back(std::move(task));
    }
    arrived_.notify_one();
}

void TaskQueue::serve(const std::stop_token& stop) {
    while (true) {
        std::unique_lock lock(mutex_);
        if (!arrived_.wait(lock, stop, [&] { return !waiting_.empty(); })) return;
        Task task = std::move(waiting_.front());
        waiting_.pop_front();
        lock.unlock();
        if (handle_(task) == Handled::done) continue;
        lock.lock();
        arrived_.wait_for(lock, stop, pause_after_trouble, [] { return false; });
        waiting_.push_back(std::move(task));
    }
}

}  // namespace breach::orchestrator
