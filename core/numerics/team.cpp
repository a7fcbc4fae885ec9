#include "core/numerics/team.hpp"

#include <algorithm>
#include <utility>

namespace breach::numerics {

namespace {

constexpr std::uint32_t members_mask = 0xffff;
constexpr std::uint32_t open = 0x10000;
constexpr std::uint32_t one_round = 0x20000;

/// Polls before a thread sleeps, yielding the core: about 0.1 ms, which waking it would cost, and
/// as long as the work between two loops.
constexpr int looks_before_sleep = 300;

std::uint32_t round_of(std::uint32_t state) { return state / one_round; }

void wait_while(const std::atomic<std::uint32_t>& state, std::uint32_t is) {
    for (int look = 0; look < looks_before_sleep; ++look) {
        if (state != is) return;
        std::this_thread::yield();
    }
    state.wait(is);
}

}  // namespace

void Team::Range::set(std::size_t begin, std::size_t end) {
    left_ = static_cast<std::uint64_t>(end) << 32 | begin;
}

std::optional<std::size_t> Team::Range::take(End from) {
    std::uint64_t left = left_;
    while (true) {
        const std::uint64_t begin = left & 0xffffffff, end = left >> 32;
        if (begin >= end) return std::nullopt;
        const bool front = from == End::front;
        const std::uint64_t rest = front ? left + 1 : left - (std::uint64_t{1} << 32);
        if (left_.compare_exchange_weak(left, rest)) return front ? begin : end - 1;
    }
}

Team::Team(int threads) : ranges_(static_cast<std::size_t>(std::max(threads, 1))) {
    for (std::size_t n = 1; n < ranges_.size(); ++n) members_.emplace_back([this, n] { serve(n); });
}

Team::~Team() {
    closing_ = true;
    state_ += one_round;
    state_.notify_all();
    for (std::thread& member : members_) member.join();
}

void Team::share_out(std::size_t tasks, Call call, const void* work) {
    call_ = call;
    work_ = work;
    for (std::size_t n = 0; n < ranges_.size(); ++n)
        ranges_[n].set(tasks * n / ranges_.size(), tasks * (n + 1) / ranges_.size());
    state_ += one_round + open;  // publishes all of the above
    state_.notify_all();
    take_tasks(0);
    state_ -= open;
    for (std::uint32_t state = state_; (state & members_mask) != 0; state = state_) {
        wait_while(state_, state);
    }
    if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

void Team::take_tasks(std::size_t own) {
    try {
        while (const auto task = ranges_[own].take(End::front)) call_(work_, *task);
        for (std::size_t n = 1; n < ranges_.size(); ++n) {
            Range& other = ranges_[(own + n) % ranges_.size()];
            while (const auto task = other.take(End::back)) call_(work_, *task);
        }
    } catch (...) {
        for (Range& each : ranges_) each.set(0, 0);
        const std::lock_guard lock(failing_);
        if (!failure_) failure_ = std::current_exception();
    }
}

void Team::serve(std::size_t own) {
    std::uint32_t last = 0;
    for (std::uint32_t state = state_;;) {
        if (closing_) return;
        if ((state & open) == 0 || round_of(state) == last) {
            wait_while(state_, state);
            state = state_;
            continue;
        }
        if (!state_.compare_exchange_weak(state, state + 1)) continue;
        last = round_of(state);
        take_tasks(own);
        state = --state_;
        if ((state & (members_mask | open)) == 0) state_.notify_all();
    }
}

}  // namespace breach::numerics
