#include "services/templates/layers.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace breach::templates {
namespace {

const Polygon square{{0, 0}, {10, 0}, {10, 10}, {0, 10}};

double whole_area(const std::vector<Polygon>& pieces) {
    return std::accumulate(pieces.begin(), pieces.end(), 0.0, [](double sum, const Polygon& each) {
        return sum + geometry::area(each);
    });
}

TEST(Divided, ALineThroughASquareLeavesBothSides) {
    const auto pieces = divided(square, {{-5, 4}, {15, 4}}, 0.01);
    ASSERT_EQ(pieces.size(), 2u);
    EXPECT_DOUBLE_EQ(whole_area(pieces), 100.0);
    EXPECT_DOUBLE_EQ(std::min(geometry::area(pieces[0]), geometry::area(pieces[1])), 40.0);
}

TEST(Divided, ALineBesideItLeavesItWhole) {
    EXPECT_EQ(divided(square, {{-5, 12}, {15, 12}}, 0.01).size(), 1u);
    EXPECT_EQ(divided(square, {{-5, 10}, {15, 10}}, 0.01).size(), 1u);  // along a side
}

TEST(Divided, ANotchedPolygonIsDividedIntoMore) {
    const Polygon comb{{0, 0}, {10, 0}, {10, 8}, {8, 2}, {6, 8}, {4, 2}, {2, 8}, {0, 2}};
    const auto pieces = divided(comb, {{-1, 4}, {11, 4}}, 0.01);
    EXPECT_EQ(pieces.size(), 4u);  // three teeth and what they stand on
    EXPECT_NEAR(whole_area(pieces), geometry::area(comb), 1e-12);
}

TEST(Divided, PlacesNearAVertexGoThere) {
    for (const Polygon& piece : divided(square, {{-5, 0.05}, {15, 9.95}}, 0.2))
        for (const Vec2& vertex : piece) EXPECT_TRUE(vertex.x() == 0.0 || vertex.x() == 10.0);
}

TEST(CutByDepth, LayersFollowTheLineAndTheLowestTakesTheRest) {
    const Line line{{0, 8}, {10, 6}};
    const auto layers = cut_by_depth(square, line, {3.0, 0.01, 0.1});
    ASSERT_EQ(layers.size(), 3u);  // above; 3 m; 3 m and what is left below them
    EXPECT_NEAR(geometry::area(layers[0].polygon), 30.0, 1e-9);
    EXPECT_NEAR(geometry::area(layers[1].polygon), 30.0, 1e-9);
    EXPECT_NEAR(geometry::area(layers[2].polygon), 40.0, 1e-9);
    for (int k = 0; k < 3; ++k) EXPECT_EQ(layers[k].number, k);
}

TEST(CutByDepth, AThinPieceIsJoinedWithItsNeighbour) {
    const Line line{{0, 9.7}, {10, 9.7}};
    EXPECT_EQ(cut_by_depth(square, line, {4.0, 0.01, 0.1}).size(), 3u);
    const auto layers = cut_by_depth(square, line, {4.0, 0.01, 1.0});
    ASSERT_EQ(layers.size(), 2u);
    EXPECT_EQ(layers[0].number, 1) << "the thin dry piece counts as what lies below it";
    EXPECT_NEAR(geometry::area(layers[0].polygon), 43.0, 1e-9);
}

TEST(CutByDepth, AThinWetLayerStaysWet) {
    const auto layers = cut_by_depth(square, {{0, 4}, {10, 4}}, {1.5, 0.01, 2.0});
    ASSERT_EQ(layers.size(), 2u);
    EXPECT_EQ(layers[0].number, 0);
    EXPECT_NEAR(geometry::area(layers[0].polygon), 60.0, 1e-9);
    EXPECT_GT(layers[1].number, 0);
}

TEST(ShareVertices, PutsANeighboursVertexIntoASide) {
    std::vector<Part> parts{{"a", "", square}, {"b", "", {{10, 3}, {12, 3}, {12, 6}, {10, 6}}}};
    share_vertices(parts);
    EXPECT_EQ(parts[0].polygon.size(), 6u);
    EXPECT_EQ(parts[1].polygon.size(), 4u);
}

}  // namespace
}  // namespace breach::templates
