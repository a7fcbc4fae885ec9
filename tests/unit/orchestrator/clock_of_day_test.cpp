// A duration is taken from the clock of the day only if the service observed it throughout.
#include "services/orchestrator/dispatch/clock_of_day.hpp"

#include <gtest/gtest.h>

namespace breach::orchestrator::clock_of_day_test {
namespace {

using namespace std::chrono_literals;

constexpr ClockReading start{.of_day = 1'000'000s, .monotonic = 50s};

/// A later reading, with the clock of the day changed by `set`.
ClockReading later(std::chrono::milliseconds passed, std::chrono::milliseconds set = 0ms) {
    return {start.of_day + passed + set, start.monotonic + passed};
}

std::int64_t of_day(ClockReading reading) { return reading.of_day.count(); }

TEST(ClockOfDay, GivesADurationOnlyOfWhatItWatched) {
    ClockOfDay clock(start);
    EXPECT_FALSE(clock.seconds_since(of_day(later(-5ms)), later(1s)))
        << "it may have been set before the service began";
    EXPECT_FALSE(clock.seconds_since(of_day(later(2h)), later(1s))) << "it was set back since then";
    EXPECT_DOUBLE_EQ(clock.seconds_since(of_day(later(1s)), later(3500ms)).value(), 2.5);
}

TEST(ClockOfDay, SetForwardMakesNoHoursOfWaiting) {
    ClockOfDay clock(start);
    EXPECT_FALSE(clock.seconds_since(of_day(later(1s)), later(2s, 1h)));
    EXPECT_FALSE(clock.seconds_since(of_day(later(1s)), later(3s, 1h))) << "nor when asked again";
    EXPECT_DOUBLE_EQ(clock.seconds_since(of_day(later(4s, 1h)), later(5s, 1h)).value(), 1.0);
}

TEST(ClockOfDay, KeptRightByLittleStepsIsStillWatched) {
    ClockOfDay clock(start);
    EXPECT_DOUBLE_EQ(clock.seconds_since(of_day(later(1s)), later(2s, 300ms)).value(), 1.3);
}

TEST(ClockOfDay, ReadsTheMachinesClocks) {
    ClockOfDay clock;
    const auto waited = clock.seconds_since(ClockReading::now().of_day.count());
    ASSERT_TRUE(waited);
    EXPECT_GE(*waited, 0.0);
    EXPECT_LT(*waited, 60.0);
}

}  // namespace
}  // namespace breach::orchestrator::clock_of_day_test
