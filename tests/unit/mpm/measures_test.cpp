#include <gtest/gtest.h>

#include "mpm_solver/measure/overlap.hpp"
#include "mpm_solver/measure/runout.hpp"
#include "mpm_solver/run.hpp"
#include "tests/unit/mpm/bodies.hpp"

namespace breach::mpm::test {
namespace {

TEST(Runout, PercentileIsWeightedByMass) {
    std::vector<std::pair<double, double>> x{{1.0, 97.0}, {2.0, 2.0}, {3.0, 1.0}};
    EXPECT_EQ(percentile(x, 0.97), 1.0);
    EXPECT_EQ(percentile(x, 0.99), 2.0);
    EXPECT_EQ(percentile(x, 0.995), 3.0);
}

TEST(Runout, ByCountLetsEveryPointWeighTheSame) {
    Points points;
    points.resize(200);
    for (int p = 0; p < 200; ++p) {
        points.x[p] = p;
        points.m[p] = p < 190 ? 1.0 : 1e-3;  // the farthest are light
        points.volume[p] = 1.0;
        points.region[p] = 0;
    }
    const Runout runout = runout_of(points, {1}, 0.0);
    EXPECT_EQ(runout.all_by_count, 197.0);
    EXPECT_EQ(runout.all, 188.0);
}

TEST(Runout, CountsMobileRegionsOnlyAndSignsDistances) {
    Points points;
    points.resize(4);
    points.x = {-5.0, 1.0, 4.0, 50.0};
    points.m = {1.0, 1.0, 1.0, 1.0};
    points.volume = {1.0, 2.0, 3.0, 4.0};
    points.region = {0, 0, 0, 1};
    const Runout runout = runout_of(points, {1, 0}, 2.0);
    EXPECT_EQ(runout.largest, 2.0);
    EXPECT_EQ(runout.beyond, 2.0);
    EXPECT_EQ(runout.beyond_95, 2.0);
    EXPECT_EQ(runout.beyond_50, 2.0);
    EXPECT_EQ(runout.volume_beyond, 3.0);
    EXPECT_EQ(runout.all, 2.0);
    EXPECT_EQ(runout_of(points, {1, 0}, 10.0).beyond, 0.0);
    EXPECT_EQ(runout_of(points, {1, 0}, 10.0).all, -6.0);
}

TEST(Overlap, IsZeroForALatticeAndDoubledByDoubling) {
    scene::Scene scene =
        one_soil(elastic(1e6, 0.3), 2000.0, rectangle(0, 0, 4, 20), 1.0, 4.0, 22.0);
    scene.mpm->left = scene::Wall::roller;
    scene.mpm->right = scene::Wall::roller;
    exchange::ParticleState state = fill_section(scene).state;
    Body once = make_body(scene, zoned_points(scene, state, "test"), "test");
    EXPECT_NEAR(OverlapMeter(once, 1.0).measure(once, {1}), 0.0, 0.01);
    for (double& volume : state.volume_0) volume *= 2.0;
    for (double& volume : state.volume) volume *= 2.0;
    Body twice = make_body(scene, zoned_points(scene, state, "test"), "test");
    EXPECT_NEAR(OverlapMeter(twice, 1.0).measure(twice, {1}), 1.0,
                0.08);  // less at the free surface
    EXPECT_EQ(OverlapMeter(twice, 1.0).measure(twice, {0}), 0.0) << "what is not mobile";
}

TEST(Sort, ChangesTheOrderAndNothingElse) {
    scene::Scene scene =
        one_soil(sand(1e6, 0.3, 1e3, 30.0), 1800.0, rectangle(0, 0, 3, 3), 0.5, 8.0, 5.0);
    scene.gravity = 9.81;
    Body body = filled_body(scene);
    std::reverse(body.points.x.begin(), body.points.x.end());
    const exchange::ParticleState before = particle_state(scene, body.points);
    body.strips.sort(body.grid, body.points, body.zones);
    const exchange::ParticleState after = particle_state(scene, body.points);
    for (std::size_t p = 0; p < before.size(); ++p) {
        EXPECT_EQ(before.position[p], after.position[p]);
    }
    for (std::size_t p = 1; p < body.points.size(); ++p) {
        const auto node = [&](std::size_t q) {
            return body.grid.nearest_node(body.grid.xi(body.points.x[q]),
                                          body.grid.eta(body.points.y[q]));
        };
        EXPECT_LE(node(p - 1), node(p));
    }
}

/// Sums in a zone's cells are reset and averaged in these cells only.
TEST(Sort, KnowsTheCellsThatEachZonesPointsReach) {
    scene::Scene scene = sand_block();
    scene.materials.push_back({.name = "other", .density = 1600.0, .law = elastic(5e6, 0.3)});
    scene.section.regions.push_back(
        {.name = "front", .material = 1, .polygon = rectangle(6, 0, 8, 1)});
    Body body = filled_body(scene);
    ASSERT_EQ(body.zones.size(), 2u);
    const double dt = courant_step(body, 0.4);
    for (int k = 0; k < 600; ++k) {
        step(body, dt);
        for (std::size_t z = 0; z < body.zones.size(); ++z) {
            const std::vector<std::int32_t>& cells = body.strips.cells(z);
            EXPECT_LT(cells.size(), body.grid.active.size());
            for (std::size_t p = body.zones[z].begin; p < body.zones[z].end; ++p) {
                ASSERT_TRUE(std::ranges::binary_search(cells, body.points.cell[p])) << k;
                ASSERT_GT(body.averages[z][body.points.cell[p]].V, 0.0) << k;
            }
        }
    }
}

TEST(Input, PointsOutsideTheGridAreRefusedWithARemedy) {
    scene::Scene scene = one_soil(elastic(1e6, 0.3), 2000.0, rectangle(1, 0, 7, 4), 1.0, 8.0, 6.0);
    exchange::ParticleState state = fill_section(scene).state;
    state.position[3] = {9.0, 1.0};
    try {
        make_body(scene, zoned_points(scene, state, "file"), "file");
        FAIL();
    } catch (const fault::BadInput& error) {
        ASSERT_EQ(error.faults().size(), 1U);
        EXPECT_EQ(error.faults()[0].pointer, "/mpm/domain_x");
    }
}

TEST(Input, UnknownRegionsAreRefused) {
    const scene::Scene scene =
        one_soil(elastic(1e6, 0.3), 2000.0, rectangle(1, 0, 7, 4), 1.0, 8.0, 6.0);
    exchange::ParticleState state = fill_section(scene).state;
    state.regions[0] = "elsewhere";
    EXPECT_THROW(zoned_points(scene, state, "file"), fault::BadInput);
}

TEST(Gaps, AreHeldToTheRoomBetweenNeighboursAndLeftToALonePoint) {
    const scene::Scene scene =
        one_soil(sand(1e6, 0.3, 1e3, 30.0), 1800.0, rectangle(0, 0, 4, 4), 0.5, 8.0, 8.0);
    Body body = filled_body(scene);
    Points& points = body.points;
    std::size_t inside = 0;
    while (points.x[inside] < 1.5 || points.y[inside] < 1.5) ++inside;
    const std::size_t alone = points.size() - 1;
    points.x[alone] = points.y[alone] = 7.1;
    for (const std::size_t p : {inside, alone}) {
        points.gap[p] = std::log(3.0);
        points.volume[p] = 3.0 * points.V[p];
    }
    OverlapMeter(body, scene.thickness).hold_gaps_to_room(body);
    EXPECT_NEAR(points.gap[inside], 0.0, 0.02) << "its neighbours fill the cell";
    EXPECT_NEAR(points.volume[inside], std::exp(points.gap[inside]) * points.V[inside], 1e-12);
    EXPECT_EQ(points.gap[alone], std::log(3.0));
    EXPECT_EQ(points.volume[alone], 3.0 * points.V[alone]);
}

TEST(StiffnessScale, KeepsTheVolumeOfStressedSoil) {
    scene::Scene scene =
        one_soil(sand(1e6, 0.3, 1e3, 30.0), 1800.0, rectangle(0, 0, 3, 3), 0.5, 8.0, 5.0);
    exchange::ParticleState state = fill_section(scene).state;
    const double K = 1e6 / (3.0 * 0.4);
    for (std::size_t p = 0; p < state.size(); ++p) {
        state.stress[p] = {-1e4, -1e4, -1e4, 0.0};
        state.volume[p] = state.volume_0[p] * (1.0 - 1e4 / K);
    }
    const ZonedPoints full = zoned_points(scene, state, "file");
    scene.mpm->stiffness_scale = 0.1;
    const ZonedPoints soft = zoned_points(scene, state, "file");
    EXPECT_NEAR(soft.points.V[0], full.points.V[0], 1e-15);
    EXPECT_NEAR(full.points.V[0], state.volume[0], 1e-15);
}

TEST(Plan, SaysWhatIsLeftOutAndWhichEntryDecides) {
    const scene::Scene scene =
        one_soil(elastic(1e6, 0.3), 2000.0, rectangle(1, 0, 7, 4), 1.0, 8.0, 6.0);
    bool closes = true;
    for (const process::PlanLine& line : plan(scene)) {
        EXPECT_FALSE(line.reason.empty());
        if (line.pointer == "/mpm/gap_closure") closes = line.use == process::Use::on;
    }
    EXPECT_FALSE(closes) << "an elastic scene has no gaps to close";
}

}  // namespace
}  // namespace breach::mpm::test
