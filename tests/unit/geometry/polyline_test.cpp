#include "core/geometry/polyline.hpp"

#include <gtest/gtest.h>

namespace breach::geometry {
namespace {

const std::vector<mechanics::Vec2> line{{0.0, 1.0}, {2.0, 5.0}, {4.0, 4.0}};

TEST(Polyline, IsStraightBetweenItsPointsAndLevelBeyondItsEnds) {
    EXPECT_DOUBLE_EQ(level_at(line, 0.5), 2.0);
    EXPECT_DOUBLE_EQ(level_at(line, 3.0), 4.5);
    for (const auto& point : line) EXPECT_EQ(level_at(line, point.x()), point.y());
    EXPECT_EQ(level_at(line, -7.0), 1.0);
    EXPECT_EQ(level_at(line, 9.0), 4.0);
}

TEST(Polyline, OrGoesOnStraightBeyondThem) {
    EXPECT_DOUBLE_EQ(straight_level_at(line, 0.5), 2.0);
    EXPECT_DOUBLE_EQ(straight_level_at(line, -1.0), -1.0);
    EXPECT_DOUBLE_EQ(straight_level_at(line, 6.0), 3.0);
}

TEST(Polyline, OfOnePointIsLevel) {
    const std::vector<mechanics::Vec2> point{{1.0, 3.0}};
    for (const double x : {0.0, 1.0, 2.0}) {
        EXPECT_EQ(level_at(point, x), 3.0);
        EXPECT_EQ(straight_level_at(point, x), 3.0);
    }
}

TEST(Polyline, SaysHowMuchOfItIsSteep) {
    EXPECT_DOUBLE_EQ(share_steeper_than(1.0, line), 0.5);
    EXPECT_EQ(share_steeper_than(0.4, line), 1.0);
    EXPECT_EQ(share_steeper_than(3.0, line), 0.0);
    EXPECT_EQ(share_steeper_than(1.0, {{1.0, 5.0}}), 0.0);
    EXPECT_EQ(share_steeper_than(1.0, {}), 0.0);
}

}  // namespace
}  // namespace breach::geometry
