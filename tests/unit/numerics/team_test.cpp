#include "core/numerics/team.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
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
