#include "mpm_solver/measure/flow.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mpm_solver/measure/gauges.hpp"
#include "mpm_solver/measure/runout.hpp"
#include "tests/unit/mpm/bodies.hpp"

namespace breach::mpm::test {
namespace {

constexpr double v = 3.0;

/// 2.5 m deep from the left end to x = 6, moving at v.
scene::Scene layer() {
    return one_soil(elastic(1e6, 0.3), 2000.0, rectangle(0, 0, 6, 2.5), 1.0, 12.0, 6.0);
}

Body moving_layer(const scene::Scene& scene) {
    return filled_body(scene, [](const mechanics::Vec2&) { return mechanics::Vec2{v, 0.0}; });
}

TEST(Flow, ProfileOfALayerIsItsDepthUpToTheWall) {
    const scene::Scene scene = layer();
    const Body body = moving_layer(scene);
    const FlowView view = flow_view(scene, body.grid);
    const std::vector<Flow> profile = flow_profile(body.points, view);
    const std::vector<double> places = profile_places(view);
    ASSERT_EQ(profile.size(), 13U);
    double volume = 0.0;
    for (std::size_t k = 0; k < profile.size(); ++k) {
        if (places[k] <= 5.0) {
            EXPECT_NEAR(profile[k].depth, 2.5, 1e-12) << places[k];
        }
        if (places[k] >= 7.0) {
            EXPECT_EQ(profile[k].depth, 0.0);
        }
        EXPECT_NEAR(profile[k].velocity, places[k] <= 6.0 ? v : 0.0, 1e-12);
        volume += profile[k].depth * (k == 0 || k + 1 == profile.size() ? 0.5 : 1.0);
    }
    EXPECT_NEAR(volume, 15.0, 1e-12);
}

TEST(Flow, DepthIsOfSoilAndNotOfTheGapsInIt) {
    const scene::Scene scene = layer();
    Body body = moving_layer(scene);
    const FlowView view = flow_view(scene, body.grid);
    const std::vector<Flow> before = flow_profile(body.points, view);
    const double beyond = runout_of(body.points, view.mobile, 2.0).volume_beyond;
    for (std::size_t p = 0; p < body.points.size(); ++p) {
        body.points.gap[p] = 1.0 + body.points.x[p];
        body.points.volume[p] *= std::exp(body.points.gap[p]);
    }
    const std::vector<Flow> opened = flow_profile(body.points, view);
    for (std::size_t k = 0; k < before.size(); ++k)
        EXPECT_NEAR(opened[k].depth, before[k].depth, 1e-12) << k;
    EXPECT_NEAR(runout_of(body.points, view.mobile, 2.0).volume_beyond, beyond, 1e-11);
}

TEST(Flow, GaugeBetweenColumnsSeesTheLayerToo) {
    const scene::Scene scene = layer();
    const Body body = moving_layer(scene);
    const FlowView view = flow_view(scene, body.grid);
    for (const double x : {0.0, 0.25, 2.5, 5.0}) {
        // Two points per cell: between lattice lines the hat function's average is off by up to
        // 1/23.
        EXPECT_NEAR(flow_at(body.points, view, x).depth, 2.5, 2.5 / 20.0) << x;
        EXPECT_NEAR(flow_at(body.points, view, x).velocity, v, 1e-12);
    }
    EXPECT_EQ(flow_at(body.points, view, 8.0).depth, 0.0);
}

TEST(Flow, ImmobileSoilHasNoDepth) {
    scene::Scene scene = layer();
    scene.section.regions.push_back(
        {.name = "ground", .material = 0, .polygon = rectangle(6, 0, 12, 1)});
    scene.mpm->runout.regions = {"soil"};
    const Body body = filled_body(scene);
    const FlowView view = flow_view(scene, body.grid);
    EXPECT_EQ(flow_at(body.points, view, 9.0).depth, 0.0);
    EXPECT_NEAR(flow_at(body.points, view, 3.0).depth, 2.5, 0.1);
}

TEST(Flow, SurfaceLiesOnWhatDoesNotMove) {
    scene::Scene scene =
        one_soil(elastic(1e6, 0.3), 2000.0, rectangle(0, 1, 6, 3.5), 1.0, 12.0, 6.0);
    scene.section.regions.push_back(
        {.name = "ground", .material = 0, .polygon = rectangle(0, 0, 9, 1)});
    scene.mpm->runout.regions = {"soil"};
    const Body body = filled_body(scene);
    const FlowView view = flow_view(scene, body.grid);
    const std::vector<double> ground =
        ground_profile(body.points, view, std::vector<double>(13, 0.0));
    const std::vector<double> surface = surface_profile(body.points, view, ground);
    const std::vector<Flow> profile = flow_profile(body.points, view);
    for (const std::size_t k : {0, 3, 5}) {
        EXPECT_NEAR(ground[k], 1.0, 1e-12);
        EXPECT_NEAR(surface[k], 3.5, 1e-12);
        EXPECT_NEAR(ground[k] + profile[k].depth, surface[k], 1e-12) << "nothing has loosened";
    }
    EXPECT_NEAR(ground[8], 1.0, 1e-12);
    EXPECT_NEAR(surface[8], 1.0, 1e-12);  // the ground's own top
    EXPECT_EQ(ground[11], 0.0);
    EXPECT_EQ(surface[11], 0.0);
}

TEST(Flow, FrontLiesWhereTheDepthIsReachedLast) {
    const FlowView view{.mobile = {1}, .width = 2.0, .thickness = 1.0, .low = 10.0, .high = 20.0};
    const std::vector<Flow> profile{{5, 0}, {0.5, 0}, {3, 0}, {1, 0}, {0, 0}, {0, 0}};
    EXPECT_DOUBLE_EQ(front_of(profile, view, 1.0), 16.0);
    EXPECT_DOUBLE_EQ(front_of(profile, view, 2.0), 15.0);
    EXPECT_EQ(front_of(profile, view, 9.0), nowhere);
}

TEST(Gauges, SeeAFlowAndNoGrains) {
    const scene::Scene scene = layer();
    Body body = moving_layer(scene);
    const FlowView view = flow_view(scene, body.grid);
    body.points.x[0] = 9.0;
    body.points.vx[0] = 50.0;
    EXPECT_GT(flow_at(body.points, view, 9.0).depth, 0.1) << "one point, so deep";
    GaugeRecords records;
    read_gauges({{"far", 9.0, 0.1}, {"in", 3.0, 0.1}}, body.points, view, records);
    EXPECT_EQ(records[0].depth.back(), 0.0);
    EXPECT_EQ(records[0].velocity.back(), 0.0);
    EXPECT_NEAR(records[1].velocity.back(), v, 1e-12);
}

TEST(Gauges, TheLargestVelocityIsThatOfAFlow) {
    const std::vector<double> depths{0.0, 0.006, 0.2, 3.0, 3.0};
    const std::vector<double> velocities{0.0, 16.9, -4.9, 3.0, 0.0};
    EXPECT_EQ(fastest_of(depths, velocities, 0.1), 4.9);
    EXPECT_EQ(fastest_of(depths, velocities, 0.0), 16.9);
    EXPECT_EQ(fastest_of(depths, velocities, 9.0), 0.0);
}

TEST(Gauges, ArrivalIsBetweenTheReadingsAroundIt) {
    const std::vector<double> times{0.0, 1.0, 2.0, 3.0};
    EXPECT_DOUBLE_EQ(*arrival_time(times, {0.0, 0.0, 1.0, 0.0}, 0.5), 1.5);
    EXPECT_DOUBLE_EQ(*arrival_time(times, {2.0, 0.0, 1.0, 0.0}, 0.5), 0.0);
    EXPECT_FALSE(arrival_time(times, {0.0, 0.1, 0.2, 0.1}, 0.5));
}

}  // namespace
}  // namespace breach::mpm::test
