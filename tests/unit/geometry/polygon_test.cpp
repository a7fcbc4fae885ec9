#include "core/geometry/polygon.hpp"

#include <gtest/gtest.h>

namespace {

using namespace breach::geometry;

const Polygon square{{0, 0}, {2, 0}, {2, 2}, {0, 2}};
const Polygon notched{{0, 0}, {4, 0}, {4, 4}, {2, 1}, {0, 4}};  // not convex, area 10

TEST(Polygon, AreaIsSignedByTheSenseOfTheRing) {
    EXPECT_DOUBLE_EQ(signed_area(square), 4.0);
    EXPECT_DOUBLE_EQ(signed_area(Polygon(square.rbegin(), square.rend())), -4.0);
    EXPECT_DOUBLE_EQ(area(notched), 10.0);
}

TEST(Polygon, KnowsInsideBorderAndOutside) {
    EXPECT_TRUE(contains(notched, {0.5, 1.0}));
    EXPECT_FALSE(contains(notched, {2.0, 2.0}));
    EXPECT_TRUE(contains(square, {2.0, 1.0}, 1e-9));
    EXPECT_FALSE(contains(square, {2.1, 1.0}, 1e-9));
}

TEST(Polygon, FindsDefects) {
    EXPECT_FALSE(defect(square));
    EXPECT_FALSE(defect(notched));
    EXPECT_TRUE(defect({{0, 0}, {1, 0}}));
    EXPECT_TRUE(defect({{0, 0}, {2, 2}, {2, 0}, {0, 2}}));          // bow tie
    EXPECT_TRUE(defect({{0, 0}, {1, 0}, {1, 0}, {1, 1}}));          // repeated vertex
    EXPECT_TRUE(defect({{0, 0}, {1, 0}, {2, 0}}));                  // no area
    EXPECT_TRUE(defect({{0, 0}, {2, 0}, {2, 2}, {1, 0}, {0, 2}}));  // touches itself
}

TEST(Polygon, OverlapIsTheSharedArea) {
    const Polygon shifted{{1, 1}, {3, 1}, {3, 3}, {1, 3}};
    const Polygon beside{{2, 0}, {3, 0}, {3, 2}, {2, 2}};
    const Polygon inside{{0.5, 0.5}, {1, 0.5}, {1, 1}};
    EXPECT_NEAR(overlap_area(square, shifted), 1.0, 1e-12);
    EXPECT_NEAR(overlap_area(square, beside), 0.0, 1e-12);
    EXPECT_NEAR(overlap_area(square, inside), 0.125, 1e-12);
    EXPECT_NEAR(overlap_area(notched, notched), 10.0, 1e-12);
}

TEST(Polygon, OverlapIsRightWhereManyVerticesLieOnOneLine) {
    // Two matching combs: eight teeth, all tips at one level, all feet at another.
    Polygon low{{0, -5}, {8, -5}}, high;
    for (int i = 0; i < 8; ++i) {
        high.push_back({double(i), 0});
        high.push_back({i + 0.5, 8});
    }
    high.push_back({8, 0});
    low.insert(low.end(), high.rbegin(), high.rend());
    high.insert(high.end(), {{8, 12}, {0, 12}});
    EXPECT_NEAR(overlap_area(low, high), 0.0, 1e-12);
    EXPECT_NEAR(overlap_area(low, low), 8 * 5 + 8 * 4, 1e-9);
    EXPECT_NEAR(overlap_area(high, high), 8 * 12 - 8 * 4, 1e-9);
}

}  // namespace
