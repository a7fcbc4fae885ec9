// Wakes the dispatcher from other threads, and mailboxes for their results.
#pragma once

#include <sys/eventfd.h>
#include <unistd.h>

#include <mutex>
#include <utility>
#include <vector>

namespace breach::orchestrator {

/// Wakes the dispatcher's thread from its poll; callable from any thread.
class Notifier {
  public:
    Notifier() : descriptor_(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {}
    ~Notifier() { close(descriptor_); }
    Notifier(const Notifier&) = delete;
    Notifier& operator=(const Notifier&) = delete;
    void notify() const { eventfd_write(descriptor_, 1); }
    void clear() const {
        eventfd_t count = 0;
        eventfd_read(descriptor_, &count);
    }
    int descriptor() const { return descriptor_; }

  private:
    int descriptor_;
};

/// Results of a thread for the dispatcher, which takes them at the start of its next round.
/// Letters that were not taken are lost when the service ends; reconcile() does not need them.
template <class Letter>
class Mailbox {
  public:
    explicit Mailbox(const Notifier& notifier) : notifier_(notifier) {}
    /// From any thread.
    void put(Letter letter) {
        {
            const std::lock_guard lock(mutex_);
            letters_.push_back(std::move(letter));
        }
        notifier_.notify();
    }
    std::vector<Letter> take() {
        const std::lock_guard lock(mutex_);
        return std::exchange(letters_, {});
    }

  private:
    const Notifier& notifier_;
    std::mutex mutex_;
    std::vector<Letter> letters_;
};

}  // namespace breach::orchestrator
