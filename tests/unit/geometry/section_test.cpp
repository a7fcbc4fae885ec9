#include "core/geometry/section.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace breach::geometry {
namespace {

/// A bench with a vertical face at x = 10 on a floor, a gap, and a block beyond it.
struct Region {
    Polygon ring;
};
const std::vector<Region> regions{{{{0, 0}, {20, 0}, {20, 2}, {0, 2}}},
                                  {{{0, 2}, {10, 2}, {10, 6}, {0, 8}}},
                                  {{}},
                                  {{{25, 0}, {30, 0}, {30, 4}, {25, 4}}}};
const Outlines outlines = outlines_of(regions, &Region::ring);

TEST(Section, KnowsItsExtentAndWhereSoilIs) {
    EXPECT_EQ(extent(outlines).low, Vec2(0, 0));
    EXPECT_EQ(extent(outlines).high, Vec2(30, 8));
    EXPECT_TRUE(in_soil(outlines, {5, 5}));
    EXPECT_FALSE(in_soil(outlines, {22, 1}));
    EXPECT_DOUBLE_EQ(distance_to_soil(outlines, {22, 1}), 2.0);
    EXPECT_EQ(distance_to_soil(outlines, {5, 5}), 0.0);
}

TEST(Section, HasStrataFromTheTopDown) {
    const std::vector<Stratum> strata = strata_at(outlines, 5.0);
    ASSERT_EQ(strata.size(), 2U);
    EXPECT_EQ(strata[0].region, 1U);
    EXPECT_DOUBLE_EQ(strata[0].top, 7.0);
    EXPECT_DOUBLE_EQ(strata[0].bottom, 2.0);
    EXPECT_EQ(strata[1].region, 0U);
    EXPECT_TRUE(strata_at(outlines, 22.0).empty());
}

TEST(Section, OfOnePolygonAnUprightMeetsTheBorderInPairs) {
    const Polygon notched{{0, 0}, {4, 0}, {4, 4}, {2, 1}, {0, 4}};
    for (const double x : {0.0, 1.0, 2.0, 3.0}) EXPECT_EQ(crossings(notched, x).size(), 2U) << x;
    EXPECT_TRUE(crossings(notched, 4.0).empty());
}

TEST(Section, GroundEndsAtFacesAndGaps) {
    EXPECT_DOUBLE_EQ(ground_at(outlines, 15.0), 2.0);
    EXPECT_TRUE(std::isinf(ground_at(outlines, 22.0)));
    const auto pieces = ground_between(outlines, 5.0, 28.0);
    ASSERT_EQ(pieces.size(), 3U);
    EXPECT_EQ(pieces[0], (std::vector<Vec2>{{5, 7}, {10, 6}}));
    EXPECT_EQ(pieces[1], (std::vector<Vec2>{{10, 2}, {20, 2}}));
    EXPECT_EQ(pieces[2], (std::vector<Vec2>{{25, 4}, {28, 4}}));
    const Levels levels = ground_over(outlines, 9.0, 12.0);
    EXPECT_NEAR(levels.highest, 6.2, 1e-5);
    EXPECT_EQ(levels.lowest, 2.0);
}

TEST(Section, ReachesBelowALine) {
    const Depth depth = deepest_below(outlines, {{0, 3}, {30, 3}}, level_at);
    EXPECT_DOUBLE_EQ(depth.below, 3.0);
    EXPECT_EQ(depth.place.y(), 0.0);
}

}  // namespace
}  // namespace breach::geometry
