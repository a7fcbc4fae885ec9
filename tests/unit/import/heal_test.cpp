// Outlines that nearly match: healed or refused.
#include "services/import/heal.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "drawings.hpp"

namespace breach::importing::heal_test {
namespace {

using test::Line;

Soil soil(const std::string& name, const Line& ring) {
    return {name, name, name, ring, {1, "LWPOLYLINE"}};
}

/// Three times the drawn size: 360 m long, 66 m high.
std::vector<Soil> section() {
    std::vector<Soil> soils{soil("rock", test::rock), soil("clay", test::clay),
                            soil("tailings", test::tailings)};
    for (Soil& each : soils)
        for (Vec2& vertex : each.ring) vertex *= 3.0;
    return soils;
}

Line jittered(Line ring, std::mt19937& random, double by) {
    std::uniform_real_distribution<double> off(-by, by);
    for (Vec2& each : ring) each += Vec2(off(random), off(random));
    return ring;
}

/// Regions that meet at each vertex: a conforming mesh needs the right ones.
std::multiset<std::set<std::string>> meetings(const std::vector<Soil>& soils) {
    std::map<std::pair<double, double>, std::set<std::string>> at;
    for (const Soil& each : soils)
        for (const Vec2& vertex : each.ring) at[{vertex.x(), vertex.y()}].insert(each.name);
    std::multiset<std::set<std::string>> all;
    for (const auto& [place, names] : at) all.insert(names);
    return all;
}

std::size_t count(const Healed& healed, const std::string& kind) {
    return static_cast<std::size_t>(std::ranges::count(healed.changes, kind, &Change::kind));
}

TEST(Heal, ASectionThatFitsIsLeftAsItIs) {
    const Healed result = healed(section(), 0.05);
    EXPECT_EQ(test::told(result.faults), "");
    ASSERT_EQ(result.soils.size(), 3u);
    EXPECT_TRUE(result.changes.empty());
    const std::vector<Soil> drawn = section();
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(result.soils[i].ring.size(), drawn[i].ring.size());
        EXPECT_EQ(geometry::area(result.soils[i].ring), geometry::area(drawn[i].ring));
    }
}

TEST(Heal, VerticesOffByACentimetreComeToTheTopologyOfTheExactSection) {
    const auto exact = meetings(healed(section(), 0.05).soils);
    for (unsigned seed = 0; seed < 40; ++seed) {
        std::mt19937 random(seed);
        std::vector<Soil> soils = section();
        for (Soil& each : soils) each.ring = jittered(each.ring, random, 0.01);
        const Healed result = healed(soils, 0.05);
        ASSERT_EQ(test::told(result.faults), "") << seed;
        EXPECT_EQ(meetings(result.soils), exact) << seed;
        ASSERT_EQ(result.soils.size(), 3u);
        for (std::size_t i = 0; i < 3; ++i) {
            const double before = geometry::area(section()[i].ring);
            EXPECT_NEAR(geometry::area(result.soils[i].ring) / before, 1.0, 1e-3) << seed;
        }
        for (const Change& each : result.changes) EXPECT_LE(each.size, 0.05) << each.kind;
    }
}

TEST(Heal, ACornerOnANeighboursSideBecomesItsVertex) {
    std::vector<Soil> soils{soil("below", {{0, 0}, {10, 0}, {10, 2}, {0, 2}}),
                            soil("left", {{0, 2}, {4, 2}, {4, 5}, {0, 5}}),
                            soil("right", {{4, 2.02}, {10, 2}, {10, 5}, {4, 5}})};
    const Healed result = healed(soils, 0.05);
    ASSERT_EQ(test::told(result.faults), "");
    EXPECT_EQ(result.soils[0].ring.size(), 5u);
    EXPECT_EQ(count(result, "junction"), 1u);
    ASSERT_EQ(count(result, "gap"), 1u);
    const auto gap = std::ranges::find(result.changes, "gap", &Change::kind);
    EXPECT_NEAR(gap->size, 0.02, 1e-12);
    EXPECT_EQ(gap->at, Vec2(4, 2));
}

TEST(Heal, WhatIsWiderThanTheToleranceIsAFaultAtItsPlace) {
    // A hole of 2 m by 0.3 m between three blocks, and a corner 0.2 m inside the neighbour.
    std::vector<Soil> soils{
        soil("below", {{0, 0}, {10, 0}, {10, 2}, {6, 2}, {6, 1.7}, {4, 1.7}, {4, 2}, {0, 2}}),
        soil("above", {{0, 2}, {10, 2}, {10, 5}, {0, 5}}),
        soil("beside", {{9.8, 2}, {14, 2}, {14, 5}, {9.8, 5}})};
    const Healed result = healed(soils, 0.05);
    ASSERT_EQ(result.faults.size(), 2u) << test::told(result.faults);
    const std::string told = test::told(result.faults);
    EXPECT_NE(told.find("a gap between below and above at (5, 1.85), 0.3 m wide, 0.6 m2"),
              std::string::npos)
        << told;
    EXPECT_NE(told.find("above and beside overlap at (9.9, 3.5), 0.2 m wide, 0.6 m2"),
              std::string::npos)
        << told;
    EXPECT_TRUE(healed(soils, 0.35).faults.empty());
}

TEST(Heal, TwiceDrawnVerticesSpikesAndSenseAreHealedAndReported) {
    const Healed result = healed(
        {soil("clay", {{0, 5}, {10, 5}, {10, 5}, {10, 0}, {13, 0}, {10, 0.001}, {10, 0}, {0, 0}})},
        0.05);
    ASSERT_EQ(test::told(result.faults), "");
    EXPECT_EQ(count(result, "spike"), 1u);
    EXPECT_EQ(count(result, "orientation"), 1u);
    EXPECT_GE(count(result, "short_side"), 2u);
    EXPECT_GT(geometry::signed_area(result.soils[0].ring), 0.0);
    EXPECT_NEAR(geometry::area(result.soils[0].ring), 50.0, 0.01);
    EXPECT_EQ(geometry::defect(result.soils[0].ring), std::nullopt);
}

TEST(Heal, ARegionWithinAnotherIsAnOverlapAndARingAroundItIsRefused) {
    const Line big{{0, 0}, {20, 0}, {20, 10}, {0, 10}}, lens{{5, 4}, {9, 4}, {9, 6}, {5, 6}};
    const Healed over = healed({soil("big", big), soil("lens", lens)}, 0.05);
    ASSERT_EQ(over.faults.size(), 1u) << test::told(over.faults);
    EXPECT_NE(over.faults[0].cause.find("big and lens overlap at"), std::string::npos);
    const Line ring{{0, 0}, {20, 0}, {20, 10}, {0, 10}, {0, 0},
                    {5, 4}, {5, 6},  {9, 6},   {9, 4},  {5, 4}};
    const Healed around = healed({soil("big", ring), soil("lens", lens)}, 0.05);
    ASSERT_EQ(around.faults.size(), 1u) << test::told(around.faults);
    EXPECT_NE(around.faults[0].cause.find("encloses another region"), std::string::npos);
}

TEST(Heal, AnOutlineThatCrossesItselfIsRefusedAtTheCrossing) {
    const Healed result = healed({soil("bow", {{0, 0}, {10, 5}, {10, 0}, {0, 5}})}, 0.05);
    ASSERT_EQ(result.faults.size(), 1u);
    EXPECT_NE(result.faults[0].cause.find("crosses itself at (5, 2.5)"), std::string::npos);
}

TEST(Heal, AWedgeThatThinsOutKeepsItsTip) {
    // 1:50, so that its last 2.5 m are thinner than the tolerance.
    const Healed result = healed({soil("below", {{0, -5}, {60, -5}, {60, 0}, {50, 0}, {0, 0}}),
                                  soil("wedge", {{0, 0}, {50, 0}, {0, 1}}),
                                  soil("above", {{0, 1}, {50, 0}, {60, 0}, {60, 4}, {0, 4}})},
                                 0.05);
    ASSERT_EQ(test::told(result.faults), "");
    EXPECT_DOUBLE_EQ(geometry::area(result.soils[1].ring), 25.0);
    EXPECT_TRUE(result.changes.empty());
}

}  // namespace
}  // namespace breach::importing::heal_test
