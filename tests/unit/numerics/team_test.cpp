#include "core/numerics/team.hpp"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

namespace breach::numerics {
namespace {

TEST(Team, DoesEveryTaskOnceInRoundsThatFollowAtOnce) {
    for (const int threads : {1, 2, 5}) {
        Team team(threads);
        std::vector<int> done(37, 0);
        constexpr int rounds = 3000;
        for (int round = 0; round < rounds; ++round)
            team.share(done.size(), [&](std::size_t task) { ++done[task]; });
        EXPECT_EQ(done, std::vector<int>(37, rounds)) << threads << " threads";
    }
}

/// Task n of both parts can wait for each other only if neither thread takes the other's.
TEST(Team, GivesEachThreadAPartOfItsOwn) {
    using Clock = std::chrono::steady_clock;
    Team team(2);
    for (int round = 0; round < 100; ++round) {
        std::array<std::atomic<bool>, 6> begun{};
        std::atomic<int> met = 0;
        const auto end = Clock::now() + std::chrono::seconds(20);
        team.share(begun.size(), [&](std::size_t task) {
            begun[task] = true;
            while (!begun[(task + 3) % 6] && Clock::now() < end) std::this_thread::yield();
            if (begun[(task + 3) % 6]) ++met;
        });
        ASSERT_TRUE(Clock::now() < end && met == 6) << "round " << round;
    }
}

TEST(Team, HelpsWhoIsBehind) {
    Team team(2);
    for (const std::size_t slow : {0, 9}) {
        std::atomic<int> others = 0;
        team.share(10, [&](std::size_t task) {
            if (task != slow) ++others;
            while (task == slow && others < 9) std::this_thread::yield();
        });
        EXPECT_EQ(others, 9);
    }
}

TEST(Team, ThrowsWhatATaskThrewAndWorksOn) {
    Team team(3);
    for (int round = 0; round < 200; ++round) {
        EXPECT_THROW(team.share(20,
                                [](std::size_t task) {
                                    if (task % 7 == 3) throw std::runtime_error("task");
                                }),
                     std::runtime_error);
        std::atomic<int> done = 0;
        team.share(20, [&](std::size_t) { ++done; });
        EXPECT_EQ(done, 20);
    }
}

}  // namespace
}  // namespace breach::numerics
