#include "mpm_solver/body/terrain.hpp"

#include <gtest/gtest.h>

#include "tests/unit/mpm/bodies.hpp"

namespace breach::mpm::test {
namespace {

using mechanics::Vec2;

constexpr double h = 1.0;

TEST(Terrain, LevelAndDistanceGoOnBeyondTheEnds) {
    const Terrain terrain({{0, 3}, {4, 0}, {10, 0}});
    EXPECT_DOUBLE_EQ(terrain.level(2.0), 1.5);
    EXPECT_NEAR(terrain.level(-4.0), 6.0, 1e-9);
    EXPECT_DOUBLE_EQ(terrain.level(100.0), 0.0);
    EXPECT_NEAR(terrain.distance({0.0 + 0.6, 3.0 + 0.8}), 1.0, 1e-9);
    EXPECT_NEAR(terrain.distance({8.0, -2.0}), -2.0, 1e-9);
    EXPECT_NEAR(terrain.distance({-4.0 + 0.3, 6.0 + 0.4}), 0.5, 1e-9);
}

TEST(Terrain, NodesAboveHalfACellFeelNothing) {
    const Terrain terrain({{0, 0}, {10, 0}});
    EXPECT_FALSE(terrain.contact({5.0, 0.51}, 0.5 * h, 0.3));
    ASSERT_TRUE(terrain.contact({5.0, 0.49}, 0.5 * h, 0.3));
    ASSERT_TRUE(terrain.contact({5.0, -7.0}, 0.5 * h, 0.3));
    EXPECT_NEAR((terrain.contact({5.0, -7.0}, 0.5 * h, 0.3)->normal - Vec2{0, 1}).norm(), 0.0,
                1e-12);
}

TEST(Terrain, ValleysHaveTwoNormalsAndRidgesATurningOne) {
    const Terrain valley({{-10, 10}, {0, 0}, {10, 10}});
    const auto corner = valley.contact({0.0, 0.2}, 0.5 * h, 0.0);
    ASSERT_TRUE(corner && corner->second);
    EXPECT_GT(corner->normal.x(), 0.7);
    EXPECT_LT(corner->second->x(), -0.7);
    EXPECT_TRUE(valley.contact({0.0, -3.0}, 0.5 * h, 0.0)->second);
    EXPECT_FALSE(valley.contact({5.0, 5.0}, 0.5 * h, 0.0)->second);

    const Terrain ridge({{-10, -10}, {0, 0}, {10, -10}});
    double last = -1.0;
    for (const double x : {-2.0, -0.6, -0.3, 0.0, 0.3, 0.6, 2.0}) {
        const auto contact = ridge.contact({x, -std::abs(x)}, 0.5 * h, 0.0);
        ASSERT_TRUE(contact) << x;
        EXPECT_FALSE(contact->second) << x;
        EXPECT_GE(contact->normal.x(), last) << x;
        EXPECT_NEAR(contact->normal.norm(), 1.0, 1e-12);
        last = contact->normal.x();
    }
    EXPECT_NEAR(ridge.contact({0.0, 0.0}, 0.5 * h, 0.0)->normal.x(), 0.0, 1e-12);
    EXPECT_NEAR(last, std::sqrt(0.5), 1e-12);
}

TEST(Contact, FrictionTakesWhatTheNodeLoses) {
    const Vec2 normal = Vec2{-1.0, 2.0}.normalized();
    const Vec2 along{normal.y(), -normal.x()};
    const double m = 3.0;
    const Vec2 v_before = 2.0 * along;  // slides already, then is pushed down
    const Vec2 pushed = v_before - 0.5 * normal;
    Vec2 v = pushed;
    const double work = rub({normal, std::nullopt, 0.4}, m, v_before, v);
    EXPECT_NEAR(normal.dot(v), 0.0, 1e-15);
    EXPECT_NEAR(along.dot(v), 2.0 - 0.4 * 0.5, 1e-15);
    EXPECT_NEAR(work, 0.5 * m * (v_before.squaredNorm() - v.squaredNorm()), 1e-12);
    Vec2 lifting = 0.1 * normal + along;
    EXPECT_EQ(rub({normal, std::nullopt, 0.4}, m, v_before, lifting), 0.0);
    EXPECT_EQ(lifting, Vec2(0.1 * normal + along));
    Vec2 held = pushed;
    rub({normal, std::nullopt, std::numeric_limits<double>::infinity()}, m, v_before, held);
    EXPECT_EQ(held.norm(), 0.0);
}

TEST(Contact, ValleyTurnsWhatSlidesInAndHoldsWhatBothSlopesStop) {
    const Vec2 left = Vec2{1.0, 2.0}.normalized();
    const Vec2 right = Vec2{-1.0, 4.0}.normalized();
    const Contact valley{left, right, 0.0};
    const Vec2 down_the_left{left.y(), -left.x()};
    Vec2 v = down_the_left;
    EXPECT_EQ(rub(valley, 1.0, v, v), 0.0);
    EXPECT_NEAR(right.dot(v), 0.0, 1e-15);
    EXPECT_GE(left.dot(v), 0.0);
    EXPECT_NEAR(v.norm(), left.dot(right), 1e-12);  // cosine of the turn
    const Contact gorge{Vec2{1.0, 0.1}.normalized(), Vec2{-1.0, 0.1}.normalized(), 0.0};
    Vec2 falling{0.0, -1.0};
    rub(gorge, 1.0, falling, falling);
    EXPECT_EQ(falling, Vec2(0.0, 0.0));
}

TEST(Terrain, BuriedPointsAreRefused) {
    scene::Scene scene = one_soil(elastic(1e6, 0.3), 2000.0, rectangle(2, 1, 4, 2), 0.5, 8.0, 4.0);
    scene.mpm->terrain = {{0, 1}, {8, 1}};
    EXPECT_NO_THROW(refuse_buried_points(filled_body(scene), "test"));
    scene.mpm->terrain = {{0, 1.5}, {8, 1}};
    EXPECT_THROW(refuse_buried_points(filled_body(scene), "test"), fault::BadInput);
}

}  // namespace
}  // namespace breach::mpm::test
