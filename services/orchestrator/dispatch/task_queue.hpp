// A queue of tasks with a thread that handles them in the order of their arrival.
#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

#include "services/orchestrator/records/records.hpp"

namespace breach::orchestrator {

/// Pause before a task that failed for an external reason (a full disk) is tried again.
inline constexpr auto pause_after_trouble = std::chrono::seconds(1);

enum class Handled { done, again_later };

class TaskQueue {
  public:
    /// `handle` is called on the queue's thread; a task to be handled `again_later` goes to the
    /// end, after a pause. An exception that leaves `handle` ends the program.
    explicit TaskQueue(std::function<Handled(const Task&)> handle);

    void add(Task task);

  private:
    void serve(const std::stop_token& stop);

    std::function<Handled(const Task&)> handle_;
    std::mutex mutex_;
    std::condition_variable_any arrived_;
    std::deque<Task> waiting_;
    std::jthread thread_;  // last: stops before the members it uses are destroyed
};

}  // namespace breach::orchestrator
