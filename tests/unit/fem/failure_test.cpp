// Depth of liquefaction and number of failure surfaces, on meshes with an evident answer.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "fem_solver/monitors/failure_surface.hpp"
#include "fem_solver/monitors/liquefaction.hpp"

namespace breach::fem {
namespace {

/// Level ground of unit squares, row by row from the lower left.
Mesh level_ground(int columns, int rows) {
    scene::Region region;
    region.name = "soil";
    const double width = columns, height = rows;
    region.polygon = {{0, 0}, {width, 0}, {width, height}, {0, height}};
    region.corners = {0, 1, 2, 3};
    region.divisions = {columns, rows};
    return map_block({region, 0});
}

std::size_t surfaces(const Mesh& mesh, const std::vector<double>& epsilon_q) {
    return failure_surfaces_of(mesh, ground_of(mesh), epsilon_q, 0.1, 1.5).count;
}

TEST(FailureSurface, GroundRunsFromTheUpperLeftToTheUpperRightCorner) {
    const Mesh mesh = level_ground(6, 3);
    const Ground ground = ground_of(mesh);
    ASSERT_EQ(ground.element.size(), 6u);
    EXPECT_EQ(ground.element.front(), 12u);
    EXPECT_EQ(ground.element.back(), 17u);
    EXPECT_DOUBLE_EQ(ground.end.back(), 6.0);
}

TEST(FailureSurface, IsABandThatMeetsTheGroundAtTwoPlaces) {
    const Mesh mesh = level_ground(10, 4);
    std::vector<double> epsilon_q(40, 0.0);
    for (const int x : {1, 8}) epsilon_q[30 + x] = epsilon_q[20 + x] = 0.2;
    EXPECT_EQ(surfaces(mesh, epsilon_q), 0u) << "two cracks do not meet";
    for (int x = 2; x < 8; ++x) epsilon_q[10 + x] = 0.2;
    EXPECT_EQ(surfaces(mesh, epsilon_q), 1u) << "joined at corners below";
    for (int y = 1; y < 4; ++y) epsilon_q[10 * y + 5] = 0.2;
    EXPECT_EQ(surfaces(mesh, epsilon_q), 2u) << "a second one branches off";
    epsilon_q[30 + 6] = 0.0999;
    EXPECT_EQ(surfaces(mesh, epsilon_q), 2u);
}

TEST(FailureSurface, AStrainedGroundIsNone) {
    const Mesh mesh = level_ground(10, 4);
    std::vector<double> epsilon_q(40, 0.0);
    for (int x = 0; x < 10; ++x) epsilon_q[30 + x] = 0.5;
    EXPECT_EQ(surfaces(mesh, epsilon_q), 0u);
    epsilon_q[34] = 0.0;
    epsilon_q[24] = 0.5;
    EXPECT_EQ(surfaces(mesh, epsilon_q), 0u) << "one sound element is no separation";
}

/// Surfaces in 40 x 16 unit squares, with strain by column and row from the lower left.
std::size_t painted(const std::function<double(int, int)>& epsilon_q) {
    const Mesh mesh = level_ground(40, 16);
    std::vector<double> strain;
    for (int y = 0; y < 16; ++y) {
        for (int x = 0; x < 40; ++x) strain.push_back(epsilon_q(x, y));
    }
    return failure_surfaces_of(mesh, ground_of(mesh), strain, 0.1, 4.0).count;
}

/// Distance of an element from a trough, from the ground at column `left` down to row `bottom` and
/// up at column 34 (0: on it).
int off_trough(int x, int y, int left, int bottom) {
    const int below = std::max(bottom - y, 0);
    const int beside = std::max({left - x, x - 34, 0});
    if (below + beside > 0) return below + beside;
    return std::min({y - bottom, x - left, 34 - x});
}

TEST(FailureSurface, OneWideBandIsOne) {
    EXPECT_EQ(painted([](int x, int y) { return off_trough(x, y, 4, 3) < 5 ? 0.5 : 0.0; }), 1u);
    EXPECT_EQ(
        painted([](int x, int y) { return std::max(0.0, 0.5 - 0.08 * off_trough(x, y, 4, 3)); }),
        1u)
        << "with a ridge in its middle";
}

TEST(FailureSurface, TwoBandsWithACommonExitAreTwo) {
    // Both end at column 34; the body between them has no strain.
    const auto either = [](int x, int y) {
        return off_trough(x, y, 4, 2) == 0 || off_trough(x, y, 14, 9) == 0;
    };
    EXPECT_EQ(painted([&](int x, int y) { return either(x, y) ? 0.5 : 0.0; }), 2u);
}

TEST(FailureSurface, TwoBandsWithBothExitsInCommonAreTwo) {
    // A lens without strain between an upper and a lower base.
    const auto base = [](int x, int y, int bottom) { return x > 4 && x < 34 && y == bottom; };
    const auto strain = [&](double between) {
        return painted([&, between](int x, int y) {
            const bool leg = (x == 4 || x == 34) && y >= 3;
            if (leg || base(x, y, 3) || base(x, y, 10)) return 0.5;
            return x > 4 && x < 34 && y > 3 && y < 10 ? between : 0.0;
        });
    };
    EXPECT_EQ(strain(0.0), 2u);
    EXPECT_EQ(strain(0.2), 2u) << "a valley above the threshold between two ridges";
    EXPECT_EQ(strain(0.45), 1u) << "no valley: one wide band";
}

TEST(FailureSurface, ASmallSoundPocketInABandIsNoSecondOne) {
    EXPECT_EQ(painted([](int x, int y) {
                  if (x >= 18 && x < 21 && y >= 4 && y < 7) return 0.0;
                  return off_trough(x, y, 4, 3) < 5 ? 0.5 : 0.0;
              }),
              1u);
}

/// 10 x 4 unit squares; absent by column and row from the lower left.
std::vector<char> absent_where(const std::function<bool(int, int)>& is_absent) {
    std::vector<char> absent;
    for (int y = 0; y < 4; ++y) {
        for (int x = 0; x < 10; ++x) absent.push_back(is_absent(x, y) ? 1 : 0);
    }
    return absent;
}

TEST(FailureSurface, TheWallOfAnExcavationIsGround) {
    const Mesh mesh = level_ground(10, 4);
    const auto absent = absent_where([](int x, int y) { return x > 5 && y > 1; });
    const Ground ground = ground_of(mesh, absent);
    ASSERT_EQ(ground.element.size(), 12u) << "top, wall and floor";
    EXPECT_EQ(ground.element.front(), 30u);
    EXPECT_EQ(ground.element.back(), 19u);
    EXPECT_DOUBLE_EQ(ground.end.back(), 12.0);
    // A band from the top to the foot of the wall cuts off four elements.
    std::vector<double> epsilon_q(40, 0.0);
    for (const int e : {31, 21, 22, 23, 24, 25}) epsilon_q[e] = 0.2;
    const auto surfaces_without = [&](const Ground& of) {
        return failure_surfaces_of(mesh, of, epsilon_q, 0.1, 1.5);
    };
    EXPECT_EQ(surfaces_without(ground_of(mesh)).count, 0u) << "as long as nothing is dug";
    const FailureSurfaces found = surfaces_without(ground);
    EXPECT_EQ(found.count, 1u);
    for (std::size_t e = 0; e < 40; ++e) EXPECT_EQ(found.slides[e], e > 31 && e < 36) << e;
}

TEST(FailureSurface, GroundOfSoilInTwoPartsRunsOverBoth) {
    const Ground ground =
        ground_of(level_ground(10, 4), absent_where([](int x, int) { return x == 4 || x == 5; }));
    ASSERT_EQ(ground.element.size(), 16u) << "two tops, two walls";
    EXPECT_EQ(ground.element.front(), 30u);
    EXPECT_EQ(ground.element.back(), 39u);
    EXPECT_DOUBLE_EQ(ground.begin[8] - ground.end[7], 2.0) << "the gap";
}

TEST(FailureSurface, GroundGoesAroundACornerWhereSoilTouches) {
    const Ground ground = ground_of(level_ground(10, 4), absent_where([](int x, int y) {
                                        return (x == 4 && y == 3) || (x == 5 && y == 2);
                                    }));
    EXPECT_EQ(ground.element.size(), 16u);
    EXPECT_EQ(ground.element.front(), 30u);
    EXPECT_EQ(ground.element.back(), 39u);
}

TEST(FailureSurface, NothingAbsentIsTheWholeGroundAndAHoleIsNone) {
    const Mesh mesh = level_ground(10, 4);
    const Ground whole = ground_of(mesh);
    for (const int y : {-1, 2}) {
        const Ground ground =
            ground_of(mesh, absent_where([&](int x, int row) { return x == 4 && row == y; }));
        EXPECT_EQ(ground.element, whole.element);
        EXPECT_EQ(ground.begin, whole.begin);
        EXPECT_EQ(ground.end, whole.end);
        EXPECT_EQ(ground.beside == whole.beside, y < 0);
    }
}

TEST(Liquefaction, DepthIsThatOfTheDeepestLiquefiedNodeBelowTheWindow) {
    const Mesh mesh = level_ground(4, 5);
    const LiquefactionWindow window{{0}, {0.5, 2.5}, 5.0, 0.7};
    const auto nodes = nodes_in(mesh, window);
    EXPECT_EQ(nodes.size(), 12u) << "two columns of six nodes";
    std::vector<double> r_u(mesh.nodes.size(), 0.0);
    EXPECT_EQ(liquefaction_depth(mesh, nodes, r_u, window), 0.0);
    for (std::size_t i = 0; i < r_u.size(); ++i) {
        if (mesh.nodes[i].x() > 2.5) r_u[i] = 1.0;
    }
    EXPECT_EQ(liquefaction_depth(mesh, nodes, r_u, window), 0.0) << "outside the window";
    for (std::size_t i = 0; i < r_u.size(); ++i) {
        if (mesh.nodes[i].y() > 1.5) r_u[i] = 0.71;
    }
    EXPECT_DOUBLE_EQ(liquefaction_depth(mesh, nodes, r_u, window), 3.0);
}

TEST(Liquefaction, RatioIsExcessPressureOverInitialVerticalStress) {
    const std::vector<double> excess(3, 15e3), sigma_v0{30e3, 20e3, 10e3};
    const auto r_u = pore_pressure_ratio(excess, sigma_v0, 12e3);
    EXPECT_DOUBLE_EQ(r_u[0], 0.5);
    EXPECT_DOUBLE_EQ(r_u[1], 0.75);
    EXPECT_EQ(r_u[2], 0.0) << "too little stress for a ratio";
}

}  // namespace
}  // namespace breach::fem
