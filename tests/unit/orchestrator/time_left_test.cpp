#include "services/orchestrator/records/time_left.hpp"

#include <gtest/gtest.h>

namespace breach::orchestrator::time_left_test {
namespace {

TEST(TimeLeft, GoesByThePaceOfEachPhaseAndTheWorkersOfNow) {
    // 10 runouts wait, two run for 30 s in total, one took 100 s; 4 transfers of 0.5 s wait.
    const std::vector<PhaseLeft> left{
        {.waiting = 10, .running = 2, .running_for = 30.0, .pace = 100.0},
        {.waiting = 4, .running = 0, .running_for = 0.0, .pace = 0.5}};
    EXPECT_DOUBLE_EQ(*time_left(left, 0.7), (1000.0 + 170.0 + 2.0) / 2.0);
    // Longer than the last ones: adds nothing and reduces nothing.
    EXPECT_DOUBLE_EQ(
        *time_left({{.waiting = 1, .running = 1, .running_for = 500.0, .pace = 100.0}}, 0.9),
        100.0);
}

TEST(TimeLeft, IsNotSaidWhereAPhaseThatWaitsHasNotRun) {
    const PhaseLeft fem{.waiting = 0, .running = 1, .running_for = 60.0, .pace = {}};
    EXPECT_FALSE(
        time_left({fem, {.waiting = 51, .running = 0, .running_for = 0.0, .pace = {}}}, 0.5));
    EXPECT_FALSE(time_left({{.waiting = 3, .running = 0, .running_for = 0.0, .pace = {}}}, 0.0));
}

TEST(TimeLeft, OfASingleTaskGoesByItsOwnProgress) {
    const PhaseLeft fem{.waiting = 0, .running = 1, .running_for = 60.0, .pace = {}};
    EXPECT_DOUBLE_EQ(*time_left({fem}, 0.25), 180.0);
    EXPECT_FALSE(time_left({fem}, 0.01));
}

}  // namespace
}  // namespace breach::orchestrator::time_left_test
