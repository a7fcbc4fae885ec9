#include "mpm_solver/body/fill.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "mpm_solver/body/overburden.hpp"
#include "tests/unit/mpm/bodies.hpp"

namespace breach::mpm::test {
namespace {

TEST(Fill, AreaAndCentroidAreThePolygons) {
    // A slope whose edges cut cells at every angle, and a re-entrant corner.
    const geometry::Polygon slope{{0.3, 0.0}, {9.7, 0.0}, {6.1, 3.3}, {4.0, 1.7}, {1.9, 4.4}};
    const double area = geometry::area(slope);
    for (const int points : {1, 2, 3, 4}) {
        scene::Scene scene = one_soil(elastic(1e6, 0.3), 2000.0, slope, 1.0, 10.0, 6.0);
        scene.mpm->fill_points = points;
        const FilledSection filled = fill_section(scene);
        ASSERT_EQ(filled.regions.size(), 1U);
        EXPECT_NEAR(filled.regions[0].sampled_area, area, 1e-12 * area);
        EXPECT_DOUBLE_EQ(filled.regions[0].polygon_area, area);
        double mass = 0.0;
        for (std::size_t p = 0; p < filled.state.size(); ++p) {
            mass += filled.state.mass[p];
            EXPECT_TRUE(geometry::contains(slope, filled.state.position[p], 0.3));
        }
        EXPECT_NEAR(mass, 2000.0 * area, 1e-9 * mass);
    }
}

TEST(Fill, LevelsAreCheckedAgainstThePolygon) {
    const geometry::Polygon pond{{0.0, 0.0}, {8.0, 0.0}, {8.0, 5.88}, {0.0, 5.88}};
    const scene::Scene scene = one_soil(elastic(1e6, 0.3), 1000.0, pond, 1.0, 8.0, 8.0);
    FilledSection filled = fill_section(scene);
    EXPECT_NEAR(filled.regions.at(0).polygon_level, 2.94, 1e-12);
    EXPECT_NEAR(filled.regions.at(0).sampled_level, 2.94, 1e-12);
    EXPECT_TRUE(is_faithful(filled.regions.at(0)));
    for (auto& x : filled.state.position)
        x.y() *= 1.03;  // 3 % of the head, half of it at the centroid
    EXPECT_FALSE(is_faithful(sampling_of(scene, filled.state).at(0)));
    for (auto& x : filled.state.position) x.y() /= 1.03;
    for (double& volume : filled.state.volume) volume *= 0.98;
    EXPECT_FALSE(is_faithful(sampling_of(scene, filled.state).at(0)));
}

TEST(Fill, CellsOfARectangleGetTheirGaussLikeLattice) {
    const scene::Scene scene =
        one_soil(elastic(1e6, 0.3), 2000.0, rectangle(1, 0, 3, 1), 1.0, 4.0, 2.0);
    const exchange::ParticleState state = fill_section(scene).state;
    ASSERT_EQ(state.size(), 8U);
    EXPECT_NEAR(state.position[0].x(), 1.25, 1e-14);
    EXPECT_NEAR(state.position[0].y(), 0.25, 1e-14);
    for (const double volume : state.volume) EXPECT_NEAR(volume, 0.25, 1e-14);
}

TEST(Fill, AMovedLatticeIsTheSameSoil) {
    const geometry::Polygon slope{{0.3, 0.0}, {9.7, 0.0}, {6.1, 3.3}, {4.0, 1.7}, {1.9, 4.4}};
    scene::Scene scene = one_soil(elastic(1e6, 0.3), 2000.0, slope, 1.0, 10.0, 6.0);
    const auto plain = fill_section(scene);
    scene.mpm->fill_shift = {0.3, 0.8};
    const auto moved = fill_section(scene);
    EXPECT_NEAR(moved.regions[0].sampled_area, plain.regions[0].sampled_area, 1e-12);
    EXPECT_NEAR(moved.regions[0].sampled_level, plain.regions[0].sampled_level, 1e-12);
    // A square not cut by edges, moved by 0.3 and 0.8 squares of half a metre.
    const auto has = [&](double x, double y) {
        return std::ranges::any_of(moved.state.position, [&](const mechanics::Vec2& each) {
            return std::abs(each.x() - x) < 1e-12 && std::abs(each.y() - y) < 1e-12;
        });
    };
    EXPECT_TRUE(has(3.25 + 0.15, 0.75 + 0.4));
}

TEST(Fill, LevelsBetweenGridLinesKeepTheirHeight) {
    const scene::Scene scene =
        one_soil(elastic(1e6, 0.3), 2000.0, rectangle(0, 0, 4, 2.94), 1.0, 4.0, 4.0);
    const exchange::ParticleState state = fill_section(scene).state;
    double moment = 0.0;
    double volume = 0.0;
    for (std::size_t p = 0; p < state.size(); ++p) {
        moment += state.volume[p] * state.position[p].y();
        volume += state.volume[p];
    }
    EXPECT_NEAR(volume, 4.0 * 2.94, 1e-12);
    EXPECT_NEAR(moment / volume, 1.47, 1e-12);
}

// Light soil over heavy soil with a notch in its side: the notch is air.
TEST(Fill, OverburdenIsTheWeightOfEveryRegionAbove) {
    scene::Scene scene =
        one_soil(elastic(1e6, 0.25), 2000.0,
                 {{0, 0}, {6, 0}, {6, 1}, {4, 2}, {6, 3}, {6, 4}, {0, 4}}, 1.0, 8.0, 8.0);
    scene.materials.push_back({.name = "light", .density = 1000.0, .law = elastic(1e6, 0.25)});
    scene.section.regions.push_back(
        {.name = "light", .material = 1, .polygon = rectangle(2, 4, 6, 5)});
    scene.gravity = 10.0;
    EXPECT_DOUBLE_EQ(overburden(scene, {}, {1.0, 1.0}), 2000.0 * 10.0 * 3.0);
    EXPECT_DOUBLE_EQ(overburden(scene, {}, {3.0, 1.0}), 2000.0 * 10.0 * 3.0 + 1000.0 * 10.0);
    EXPECT_DOUBLE_EQ(overburden(scene, {}, {5.0, 0.5}), 2000.0 * 10.0 * 2.5 + 1000.0 * 10.0);
    EXPECT_DOUBLE_EQ(overburden(scene, {}, {3.0, 4.5}), 1000.0 * 10.0 * 0.5);
}

TEST(Fill, PointsStartUnderTheirOverburdenAndStayAtRest) {
    scene::Scene scene = one_soil(elastic(2e7, 0.25), 2000.0, rectangle(0, 0, 4, 6), 0.5, 4.0, 8.0);
    scene.gravity = 10.0;
    scene.mpm->left = scene.mpm->right = scene::Wall::roller;
    scene.mpm->fill_stress = scene::FillStress::overburden;
    for (const double scale : {1.0, 0.05}) {
        scene.mpm->stiffness_scale = scale;
        Body body = filled_body(scene);
        for (std::size_t p = 0; p < body.points.size(); ++p) {
            const double sigma_v = 2000.0 * 10.0 * (6.0 - body.points.y[p]);
            EXPECT_NEAR(body.points.syy[p], -sigma_v, 1e-9 * sigma_v);
            EXPECT_NEAR(body.points.sxx[p], -sigma_v / 3.0, 1e-9 * sigma_v);
            EXPECT_NEAR(body.points.V[p], 0.0625, 1e-12);
        }
        const mechanics::Vec2 start = centre_of_mass(body.points);
        advance(body, scene, 0.5);
        // The part of a linear stress that the grid cannot represent moves the points by far less
        // than the settlement without initial stress, rho g H^2 / (2 M) = 15 mm at full stiffness.
        EXPECT_LT((centre_of_mass(body.points) - start).norm(), 1e-3 / scale);
    }
}

}  // namespace
}  // namespace breach::mpm::test
