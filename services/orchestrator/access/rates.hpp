// How many requests one sender may make: a bucket for each, which fills steadily and from which each request takes one.
#pragma once

#include <algorithm>
#include <chrono>
#include <mutex>
#include <string>
#include <unordered_map>

namespace breach::orchestrator {

class Rates {
  public:
    using Clock = std::chrono::steady_clock;

    /// per_second: how fast a bucket fills; it holds what comes in `burst_seconds`, at least one. 0: no limit.
    explicit Rates(double per_second)
        : per_second_(per_second), most_(std::max(1.0, per_second * burst_seconds)) {}

    /// Seconds until the sender's next request may come; 0: this one may, and is counted.
    double wait_of(const std::string& sender, Clock::time_point now = Clock::now());

    static constexpr double burst_seconds = 4.0;
    /// Senders known at a time; those beyond share one bucket, so that no crowd of addresses takes memory.
    static constexpr std::size_t most_senders = 10000;

  private:
    struct Bucket {
        double left;
        Clock::time_point at;
    };
    void forget_full(Clock::time_point now);
    double left_in(const Bucket& bucket, Clock::time_point now) const;

    double per_second_;
    double most_;  ///< in a bucket
    std::mutex mutex_;
    std::unordered_map<std::string, Bucket> buckets_;
    Clock::time_point swept_;
};

}  // namespace breach::orchestrator
