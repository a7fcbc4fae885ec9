#include "transfer_tool/liquefied_zone.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/verification/transfer/meshes.hpp"

namespace breach::transfer {
namespace {

// 6 columns of 2 m, 5 rows of 2 m, water to the top; a node's r_u is the mean of its elements'.
TEST(LiquefiedZone, ReachesDownToTheDeepestNodeOfEveryColumn) {
    auto mesh = meshes::grid({});
    meshes::soak(mesh, 10.0, [](const Vec2& x) {
        return x.x() < 4.1 && x.y() > 3.9 && x.y() < 6.1 ? 1.0 : 0.0;
    });
    const LiquefiedZone zone(mesh, {1}, 0.55);
    // At x = 0 and 2 two thirds at y = 4, 0.875 at y = 6; at x = 4, half liquefied, 0.5 and 0.656.
    EXPECT_EQ(zone.liquefied_nodes(), 5u);
    EXPECT_EQ(zone.deepest_level(), 4.0);
    // The node at x = 2 stands for 1 to 3, the one at x = 4 for 3 to 5.
    EXPECT_TRUE(zone.holds({2.9, 4.0}));
    EXPECT_TRUE(zone.holds({2.9, 9.9})) << "all soil above, liquefied itself or not";
    EXPECT_FALSE(zone.holds({2.9, 3.9}));
    EXPECT_TRUE(zone.holds({3.1, 6.1}));
    EXPECT_FALSE(zone.holds({3.1, 5.9}));
    EXPECT_TRUE(zone.holds({4.9, 9.0}));
    EXPECT_FALSE(zone.holds({5.1, 9.0}));
}

TEST(LiquefiedZone, IsEmptyWhereThePressureOnlyAlternatesFromNodeToNode) {
    auto mesh = meshes::grid({});
    meshes::soak(mesh, 10.0, [](const Vec2&) { return 0.0; });
    for (std::size_t i = 0; i < mesh.position_0.size(); ++i) {
        const Vec2& x = mesh.position_0[i];
        const bool even = std::lround(0.5 * (x.x() + x.y())) % 2 == 0;
        mesh.pore_pressure[i] += even ? 80e3 : -80e3;
    }
    EXPECT_EQ(LiquefiedZone(mesh, {1}, 0.7).liquefied_nodes(), 0u);
}

TEST(LiquefiedZone, IsEmptyWhenNothingIsAboveTheThreshold) {
    auto mesh = meshes::grid({});
    meshes::soak(mesh, 10.0, [](const Vec2&) { return 0.69; });
    const LiquefiedZone zone(mesh, {1}, 0.7);
    EXPECT_EQ(zone.liquefied_nodes(), 0u);
    EXPECT_EQ(zone.deepest_level(), std::numeric_limits<double>::infinity());
    EXPECT_FALSE(zone.holds({5.0, 5.0}));
}

TEST(LiquefiedZone, OnlySoilThatCanLiquefyCounts) {
    auto mesh = meshes::grid({.regions = 2});  // borders at x = 6
    meshes::soak(mesh, 10.0, [](const Vec2&) { return 1.0; });
    const LiquefiedZone zone(mesh, {1, 0}, 0.7);
    EXPECT_TRUE(zone.holds({1.0, 5.0}));
    EXPECT_TRUE(zone.holds({5.9, 5.0}));
    EXPECT_FALSE(zone.holds({6.1, 5.0}));
}

// No stress, no ratio: the dry surface with its pressure of nearly nothing does not liquefy.
TEST(LiquefiedZone, NodesWithoutStressDoNotCount) {
    auto mesh = meshes::grid({});
    meshes::soak(mesh, 5.0, [](const Vec2&) { return 0.0; });
    for (double& u : mesh.pore_pressure) u += 1.0;
    EXPECT_EQ(LiquefiedZone(mesh, {1}, 0.7).liquefied_nodes(), 0u);
}

}  // namespace
}  // namespace breach::transfer
