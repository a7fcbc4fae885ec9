// A duration is taken from the clock of the day only where somebody watched it all the while.
#include "services/orchestrator/dispatch/clock_of_day.hpp"

#include <gtest/gtest.h>

namespace breach::orchestrator {
namespace {

TEST(ClockOfDay, GivesADurationOnlyOfWhatItWatched) {
    const std::int64_t earlier = epoch_ms() - 5;
    ClockOfDay clock;
    EXPECT_FALSE(clock.seconds_since(earlier)) << "it may have been set before the service began";
    EXPECT_FALSE(clock.seconds_since(epoch_ms() + 7'200'000)) << "it was set back since then";
    const auto waited = clock.seconds_since(epoch_ms());
    ASSERT_TRUE(waited);
    EXPECT_GE(*waited, 0.0);
    EXPECT_LT(*waited, 60.0);
}

}  // namespace
}  // namespace breach::orchestrator
