// Threads that share the tasks of a loop. Between loops they look for the next one a while, letting
// whoever wants the core have it, and sleep then. Nobody waits for one that wakes late: the caller
// does its tasks. Which thread takes a task is a matter of luck, so tasks must not depend on it.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace breach::numerics {

class Team {
  public:
    /// `threads` >= 1, the caller's included.
    explicit Team(int threads);
    ~Team();
    Team(const Team&) = delete;
    Team& operator=(const Team&) = delete;

    std::size_t threads() const { return members_.size() + 1; }

    /// Calls work(task) for task = 0 .. tasks - 1, each once, and returns when all are done. The first
    /// exception is thrown again here; tasks that nobody has taken by then may be left out.
    template <class Work>
    void share(std::size_t tasks, const Work& work) {
        if (members_.empty() || tasks < 2) {
            for (std::size_t task = 0; task < tasks; ++task) work(task);
            return;
        }
        share_out(
            tasks,
            [](const void* what, std::size_t task) { (*static_cast<const Work*>(what))(task); },
            &work);
    }

  private:
    using Call = void (*)(const void*, std::size_t);
    void share_out(std::size_t tasks, Call call, const void* work);
    void take_tasks();
    void serve();

    Call call_ = nullptr;
    const void* work_ = nullptr;
    std::size_t tasks_ = 0;
    std::atomic<std::size_t> next_{0};
    /// Number of the round, whether it is open, and how many members are at work in it.
    std::atomic<std::uint32_t> state_{0};
    std::atomic<bool> closing_{false};
    std::mutex failing_;
    std::exception_ptr failure_;
    std::vector<std::thread> members_;
};

}  // namespace breach::numerics
