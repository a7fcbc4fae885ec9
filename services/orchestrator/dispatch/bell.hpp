// What other threads ring the dispatcher's with, and leave for it until it looks.
#pragma once

#include <sys/eventfd.h>
#include <unistd.h>

#include <mutex>
#include <utility>
#include <vector>

namespace breach::orchestrator {

/// Wakes the dispatcher's thread out of its poll; may be rung by any thread.
class Bell {
  public:
    Bell() : descriptor_(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {}
    ~Bell() { close(descriptor_); }
    Bell(const Bell&) = delete;
    Bell& operator=(const Bell&) = delete;
    void ring() const { eventfd_write(descriptor_, 1); }
    void silence() const {
        eventfd_t count = 0;
        eventfd_read(descriptor_, &count);
    }
    int descriptor() const { return descriptor_; }

  private:
    int descriptor_;
};

template <class Letter>
class Mailbox {
  public:
    explicit Mailbox(const Bell& bell) : bell_(bell) {}
    /// Any thread may.
    void put(Letter letter) {
        {
            const std::lock_guard lock(mutex_);
            letters_.push_back(std::move(letter));
        }
        bell_.ring();
    }
    std::vector<Letter> take() {
        const std::lock_guard lock(mutex_);
        return std::exchange(letters_, {});
    }

  private:
    const Bell& bell_;
    std::mutex mutex_;
    std::vector<Letter> letters_;
};

}  // namespace breach::orchestrator
