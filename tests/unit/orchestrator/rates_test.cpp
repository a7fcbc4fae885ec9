#include "services/orchestrator/access/rates.hpp"

#include <gtest/gtest.h>

namespace breach::orchestrator::rates_test {
namespace {

using std::chrono::milliseconds;

TEST(Rates, FourSecondsWorthMayComeAtOnceAndThenAsFastAsItFills) {
    Rates rates(10);
    const Rates::Clock::time_point start{};
    for (int i = 0; i < 40; ++i) ASSERT_EQ(rates.wait_of("anna", start), 0.0) << i;
    EXPECT_NEAR(rates.wait_of("anna", start), 0.1, 1e-9);
    EXPECT_EQ(rates.wait_of("ben", start), 0.0) << "each has a count of its own";
    EXPECT_NEAR(rates.wait_of("anna", start + milliseconds(60)), 0.04, 1e-9);
    EXPECT_EQ(rates.wait_of("anna", start + milliseconds(110)), 0.0);
    EXPECT_GT(rates.wait_of("anna", start + milliseconds(110)), 0.0);
    const auto later = start + std::chrono::hours(1);
    for (int i = 0; i < 40; ++i)
        ASSERT_EQ(rates.wait_of("anna", later), 0.0) << "no more than it holds";
    EXPECT_GT(rates.wait_of("anna", later), 0.0);
}

TEST(Rates, ZeroIsNoLimit) {
    Rates rates(0);
    for (int i = 0; i < 1000; ++i) ASSERT_EQ(rates.wait_of("anna"), 0.0);
}

TEST(Rates, ACrowdSharesOneBucketUntilOthersAreFullAgain) {
    Rates rates(1);
    auto now = Rates::Clock::time_point{} + std::chrono::hours(1);
    for (std::size_t i = 0; i < Rates::most_senders; ++i)
        ASSERT_EQ(rates.wait_of(std::to_string(i), now), 0.0);
    int taken = 0;
    for (int i = 0; i < 20; ++i) taken += rates.wait_of("late " + std::to_string(i), now) == 0.0;
    EXPECT_EQ(taken, 4);
    now += std::chrono::seconds(10);
    for (int i = 0; i < 20; ++i) EXPECT_EQ(rates.wait_of("later " + std::to_string(i), now), 0.0);
}

}  // namespace
}  // namespace breach::orchestrator::rates_test
