// Threads that share the tasks of a loop. Each begins with a part of its own, the same in every loop of as
// many tasks, so that its data stay in its core's cache; a thread that has finished helps the others from
// their end. Between loops the threads poll for the next one for a while, yielding the core, and then
// sleep. No thread waits for one that wakes late: the caller does its tasks. Which thread runs a task is
// random, so tasks must not depend on it.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <mutex>
#include <optional>
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

    /// Calls work(task) for task = 0 .. tasks - 1, each once, and returns when all are done. Rethrows
    /// the first exception; tasks not yet taken by then may be left out.
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
    enum class End { front, back };

    /// Tasks not yet taken, [begin, end) in one word; on a cache line of its own.
    class alignas(64) Range {
      public:
        void set(std::size_t begin, std::size_t end);
        std::optional<std::size_t> take(End from);

      private:
        std::atomic<std::uint64_t> left_{0};
    };

    void share_out(std::size_t tasks, Call call, const void* work);
    void take_tasks(std::size_t own);
    void serve(std::size_t own);

    Call call_ = nullptr;
    const void* work_ = nullptr;
    std::vector<Range> ranges_;  ///< the caller's, then the members'
    /// Number of the round, whether it is open, and how many members are at work in it.
    std::atomic<std::uint32_t> state_{0};
    std::atomic<bool> closing_{false};
    std::mutex failing_;
    std::exception_ptr failure_;
    std::vector<std::thread> members_;
};

}  // namespace breach::numerics
