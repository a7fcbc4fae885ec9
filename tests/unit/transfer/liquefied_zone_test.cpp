#include "transfer_tool/liquefied_zone.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/verification/transfer/meshes.hpp"

namespace breach::transfer {
namespace {

/// 6 columns of 2 m, 5 rows of 2 m, water to the top; r_u = 1 at the listed nodes.
meshes::MeshSnapshot soaked(const std::vector<Vec2>& liquefied) {
    auto mesh = meshes::grid({});
    meshes::soak(mesh, 10.0, [&](const Vec2& x) {
        for (const Vec2& each : liquefied)
            if ((each - x).norm() < 1e-9) return 1.0;
        return 0.0;
    });
    return mesh;
}

TEST(LiquefiedZone, ReachesDownToTheDeepestNodeOfEveryColumn) {
    const LiquefiedZone zone(soaked({{4, 4}, {4, 8}, {6, 6}}), {1}, 0.7);
    EXPECT_EQ(zone.liquefied_nodes(), 3u);
    EXPECT_EQ(zone.deepest_level(), 4.0);
    // The node at x = 4 stands for 3 to 5, the one at x = 6 for 5 to 7.
    EXPECT_TRUE(zone.holds({3.1, 4.0}));
    EXPECT_TRUE(zone.holds({4.9, 9.9})) << "all soil above, liquefied itself or not";
    EXPECT_FALSE(zone.holds({4.0, 3.9}));
    EXPECT_TRUE(zone.holds({5.1, 6.1}));
    EXPECT_FALSE(zone.holds({5.1, 5.9}));
    EXPECT_FALSE(zone.holds({2.9, 9.0}));
    EXPECT_FALSE(zone.holds({7.1, 9.0}));
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
