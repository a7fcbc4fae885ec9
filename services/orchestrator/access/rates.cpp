#include "services/orchestrator/access/rates.hpp"

namespace breach::orchestrator {

double Rates::left_in(const Bucket& bucket, Clock::time_point now) const {
    const double since = std::chrono::duration<double>(now - bucket.at).count();
    return std::min(most_, bucket.left + per_second_ * std::max(0.0, since));
}

/// At most once a second: who comes when all places are taken must not make everybody slow.
void Rates::forget_full(Clock::time_point now) {
    if (now - swept_ < std::chrono::seconds(1)) return;
    swept_ = now;
    std::erase_if(buckets_, [&](const auto& each) { return left_in(each.second, now) >= most_; });
}

double Rates::wait_of(const std::string& sender, Clock::time_point now) {
    if (per_second_ <= 0.0) return 0.0;
    const std::lock_guard lock(mutex_);
    auto found = buckets_.find(sender);
    if (found == buckets_.end()) {
        if (buckets_.size() >= most_senders) forget_full(now);
        const std::string name = buckets_.size() < most_senders ? sender : std::string();
        found = buckets_.try_emplace(name, Bucket{most_, now}).first;
    }
    Bucket& bucket = found->second;
    bucket = {left_in(bucket, now), now};
    if (bucket.left < 1.0) return (1.0 - bucket.left) / per_second_;
    bucket.left -= 1.0;
    return 0.0;
}

}  // namespace breach::orchestrator
