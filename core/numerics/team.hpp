// Threads that share the tasks of a loop. Each starts with its own part, the same in every loop of
// equal length, so that its data stay in its core's cache; a thread that has finished takes tasks
// from the end of other parts. Between loops the threads poll for a while, then sleep. The caller
// takes the tasks of a thread that wakes late. Which thread runs a task is random: tasks must not
// depend on it.
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
    /// `threads` >= 1, including the caller.
    explicit Team(int threads);
    ~Team();
    Team(const Team&) = delete;
    Team& operator=(const Team&) = delete;

    std::size_t threads() const { return members_.size() + 1; }

    /// Calls work(task) for task = 0 .. tasks - 1, each once, and returns when all are done.
    /// Rethrows the first exception; tasks not begun by then may be skipped.
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

    /// Remaining tasks [begin, end) in one word, on its own cache line.
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
    /// Number of the round, whether it is open, and how many members work in it.
    std::atomic<std::uint32_t> state_{0};
    std::atomic<bool> closing_{false};
    std::mutex failing_;
    std::exception_ptr failure_;
    std::vector<std::thread> members_;
};

}  // namespace breach::numerics
