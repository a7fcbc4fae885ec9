#include "core/liquefied/liquefied_zone.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/exchange/excess_pressure.hpp"
#include "tests/verification/transfer/meshes.hpp"

namespace breach::liquefied {

namespace meshes = transfer::meshes;
namespace {

using scene::LiquefiedWhen;

// 6 columns of 2 m, 5 rows of 2 m, water to the top; a node's r_u is the mean of its elements'.
TEST(LiquefiedZone, ReachesDownToTheDeepestNodeOfEveryColumn) {
    auto mesh = meshes::grid({});
    meshes::soak(mesh, 10.0, [](const Vec2& x) {
        return x.x() < 4.1 && x.y() > 3.9 && x.y() < 6.1 ? 1.0 : 0.0;
    });
    const LiquefiedZone zone(mesh, {1}, 0.55, LiquefiedWhen::ever);
    // At x = 0 and 2 two thirds at y = 4, 0.875 at y = 6; at x = 4, half liquefied, 0.5 and 0.656.
    EXPECT_EQ(zone.liquefied_nodes(), 5u);
    EXPECT_EQ(zone.deepest_level(), 4.0);
    // The node at x = 2 represents 1 to 3, the one at x = 4 represents 3 to 5.
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
    EXPECT_EQ(LiquefiedZone(mesh, {1}, 0.7, LiquefiedWhen::ever).liquefied_nodes(), 0u);
}

TEST(LiquefiedZone, IsEmptyWhenNothingIsAboveTheThreshold) {
    auto mesh = meshes::grid({});
    meshes::soak(mesh, 10.0, [](const Vec2&) { return 0.69; });
    const LiquefiedZone zone(mesh, {1}, 0.7, LiquefiedWhen::ever);
    EXPECT_EQ(zone.liquefied_nodes(), 0u);
    EXPECT_EQ(zone.deepest_level(), std::numeric_limits<double>::infinity());
    EXPECT_FALSE(zone.holds({5.0, 5.0}));
}

TEST(LiquefiedZone, OnlySoilThatCanLiquefyCounts) {
    auto mesh = meshes::grid({.regions = 2});  // borders at x = 6
    meshes::soak(mesh, 10.0, [](const Vec2&) { return 1.0; });
    const LiquefiedZone zone(mesh, {1, 0}, 0.7, LiquefiedWhen::ever);
    EXPECT_TRUE(zone.holds({1.0, 5.0}));
    EXPECT_TRUE(zone.holds({5.9, 5.0}));
    EXPECT_FALSE(zone.holds({6.1, 5.0}));
}

/// Liquefied down to y = 2 m of 10, except in a strip, where to `level`.
LiquefiedZone zone_with(double from, double to, double level, double narrowest_wall = 0.0) {
    auto mesh = meshes::grid({.nx = 60, .ny = 20, .width = 30.0});
    meshes::soak(mesh, 10.0, [&](const Vec2& x) {
        const bool in_strip = x.x() > from && x.x() < to;
        return x.y() > (in_strip ? level : 2.0) ? 1.0 : 0.0;
    });
    return LiquefiedZone(mesh, {1}, 0.7, LiquefiedWhen::ever, narrowest_wall);
}

std::vector<LiquefiedGap> gaps_with(double from, double to, double level) {
    return zone_with(from, to, level).gaps();
}

TEST(LiquefiedZone, AWallOfSoundSoilWithinItIsAGap) {
    const auto found = gaps_with(14.0, 15.0, 20.0);
    ASSERT_EQ(found.size(), 1u);
    // Only the nodes at 14.5 m are in the strip: those on its sides have r_u = 0.75, and 0.56 in
    // the row where the zone ends.
    EXPECT_NEAR(found[0].from, 14.25, 1e-9);
    EXPECT_NEAR(found[0].to, 14.75, 1e-9);
    EXPECT_EQ(found[0].level, 10.0) << "not at all: the highest soil";
    EXPECT_NEAR(found[0].beside, 3.0, 1e-9);
    const auto shallow = gaps_with(14.0, 15.0, 7.0);
    ASSERT_EQ(shallow.size(), 1u);
    EXPECT_NEAR(shallow[0].level, 7.5, 1e-9);
}

TEST(LiquefiedZone, WhatIsWideOrShallowOrHasOneSideIsNone) {
    EXPECT_TRUE(gaps_with(12.0, 18.0, 20.0).empty()) << "wide";
    EXPECT_TRUE(gaps_with(14.0, 15.0, 3.0).empty()) << "shallow";
    EXPECT_TRUE(gaps_with(29.0, 30.5, 20.0).empty()) << "the zone's end";
    EXPECT_TRUE(gaps_with(-1.0, -0.5, 20.0).empty()) << "no strip";
}

TEST(LiquefiedZone, AWallNarrowerThanAskedIsLiquefiedToTheShallowerSide) {
    const LiquefiedZone open = zone_with(14.0, 15.0, 20.0),
                        closed = zone_with(14.0, 15.0, 20.0, 0.6);
    EXPECT_FALSE(open.holds({14.5, 9.9}));
    EXPECT_EQ(open.closed_width(), 0.0);
    EXPECT_TRUE(closed.gaps().empty());
    EXPECT_TRUE(closed.holds({14.5, 3.1}));
    EXPECT_FALSE(closed.holds({14.5, 2.9})) << "no deeper than its sides";
    EXPECT_NEAR(closed.closed_width(), 0.5, 1e-9);
    EXPECT_EQ(closed.deepest_level(), open.deepest_level());
    EXPECT_EQ(zone_with(14.0, 15.0, 20.0, 0.5).gaps().size(), 1u) << "as wide as asked: it stays";
    EXPECT_TRUE(zone_with(14.0, 15.0, 7.0, 0.6).holds({14.5, 3.1})) << "a wall that begins lower";
}

TEST(LiquefiedZone, AWideWallAndTheZonesEndsStay) {
    const LiquefiedZone wide = zone_with(12.0, 18.0, 20.0, 3.0);
    EXPECT_FALSE(wide.holds({15.0, 9.0}));
    const LiquefiedZone end = zone_with(28.0, 30.5, 20.0, 10.0);
    EXPECT_FALSE(end.holds({29.5, 9.0}));
    // With 10 m, a wall of 6 m is closed, and the zone beside it is unchanged.
    const LiquefiedZone closed = zone_with(12.0, 18.0, 20.0, 10.0);
    EXPECT_TRUE(closed.holds({15.0, 9.0}));
    EXPECT_EQ(closed.holds({11.0, 2.1}), wide.holds({11.0, 2.1}));
}

TEST(LiquefiedGaps, AreGoneWithTheWallThatTheFlagNames) {
    const auto flag = flag_of(gaps_with(14.0, 15.0, 20.0), 0.4);
    ASSERT_EQ(flag->severity, fault::Severity::questionable);
    EXPECT_NE(flag->message.find("--set /transfer/liquefied/narrowest_wall=0.8"), std::string::npos)
        << flag->message;
    EXPECT_TRUE(zone_with(14.0, 15.0, 20.0, 0.8).gaps().empty());
}

TEST(LiquefiedGaps, NarrowerThanTwoCellsForbidToRelyOnARunout) {
    EXPECT_FALSE(flag_of({}, 2.5).has_value());
    const LiquefiedGap narrow{.from = 97.26, .to = 99.94, .level = 29.4, .beside = 13.28};
    const LiquefiedGap wide{.from = 60.0, .to = 65.5, .level = 25.0, .beside = 15.0};
    const auto both = flag_of({wide, narrow}, 2.5);
    ASSERT_TRUE(both.has_value());
    EXPECT_EQ(both->severity, fault::Severity::questionable);
    EXPECT_NE(both->message.find("from x = 97.26 to 99.94 m"), std::string::npos) << both->message;
    EXPECT_NE(both->message.find("(2 such gaps)"), std::string::npos);
    const auto one = flag_of({wide}, 2.5);
    ASSERT_TRUE(one.has_value());
    EXPECT_EQ(one->severity, fault::Severity::warning);
    EXPECT_EQ(one->message.find("--set"), std::string::npos) << "two cells do not close it";
    EXPECT_EQ(flag_of({narrow}, 1.25)->severity, fault::Severity::warning);
    EXPECT_EQ(flag_of({narrow}, 0.0)->severity, fault::Severity::warning) << "no runout";
}

// At t_T the pore pressure has fallen everywhere; earlier, liquefaction reached down to y = 4.
TEST(LiquefiedZone, WhatHasLiquefiedOnceStaysSoUnlessTheInstantIsAskedFor) {
    auto before = meshes::grid({});
    meshes::soak(before, 10.0, [](const Vec2& x) { return x.y() > 3.9 ? 1.0 : 0.0; });
    auto mesh = meshes::grid({});
    meshes::soak(mesh, 10.0, [](const Vec2&) { return 0.3; });
    mesh.excess_pressure_max = exchange::nodal_excess_pressure(before);
    const LiquefiedZone ever(mesh, {1}, 0.7, LiquefiedWhen::ever);
    EXPECT_EQ(ever.deepest_level(), 6.0) << "at y = 4 the mean over a node's elements is below 0.7";
    EXPECT_TRUE(ever.holds({5.0, 6.1}));
    EXPECT_EQ(LiquefiedZone(mesh, {1}, 0.7, LiquefiedWhen::at_transfer).liquefied_nodes(), 0u);
}

// Without stress no ratio: the dry surface with almost no pressure does not liquefy.
TEST(LiquefiedZone, NodesWithoutStressDoNotCount) {
    auto mesh = meshes::grid({});
    meshes::soak(mesh, 5.0, [](const Vec2&) { return 0.0; });
    for (double& u : mesh.pore_pressure) u += 1.0;
    EXPECT_EQ(LiquefiedZone(mesh, {1}, 0.7, LiquefiedWhen::ever).liquefied_nodes(), 0u);
}

}  // namespace
}  // namespace breach::liquefied
