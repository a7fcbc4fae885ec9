#include "core/numerics/team.hpp"

#include <utility>

namespace breach::numerics {

namespace {

constexpr std::uint32_t members_mask = 0xffff;
constexpr std::uint32_t open = 0x10000;
constexpr std::uint32_t one_round = 0x20000;

/// Looks before a sleep, each yielding the core: some 0.1 ms, about what waking a sleeper costs and as
/// long as the work between two loops.
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

Team::Team(int threads) {
    for (int n = 1; n < threads; ++n) members_.emplace_back([this] { serve(); });
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
    tasks_ = tasks;
    next_ = 0;
    state_ += one_round + open;  // publishes all of the above
    state_.notify_all();
    take_tasks();
    state_ -= open;
    for (std::uint32_t state = state_; (state & members_mask) != 0; state = state_) {
        wait_while(state_, state);
    }
    if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

void Team::take_tasks() {
    try {
        for (std::size_t task = next_++; task < tasks_; task = next_++) call_(work_, task);
    } catch (...) {
        next_ = tasks_;
        const std::lock_guard lock(failing_);
        if (!failure_) failure_ = std::current_exception();
    }
}

void Team::serve() {
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
        take_tasks();
        state = --state_;
        if ((state & (members_mask | open)) == 0) state_.notify_all();
    }
}

}  // namespace breach::numerics
