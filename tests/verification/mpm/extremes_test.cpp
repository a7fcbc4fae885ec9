// The right result, or at least a bounded one, in cases where codes tend to fail.
#include "mpm_solver/measure/guard.hpp"
#include "tests/unit/mpm/bodies.hpp"
#include "tests/verification/mpm/report.hpp"

namespace breach::mpm::test::extremes_test {
namespace {

scene::Scene heap(const materials::Law& law) {
    scene::Scene scene = one_soil(law, 1800.0, rectangle(0, 0, 4, 4), 0.5, 30.0, 8.0);
    scene.gravity = 9.81;
    scene.mpm->left = scene::Wall::roller;
    scene.mpm->floor.friction = {{0.0, 30.0, 0.5}};
    return scene;
}

void require_whole(const Body& body, const Limits& limits) {
    if (const auto complaint = step_complaint(body, limits)) throw std::runtime_error(*complaint);
}

/// Runs with the guard after every step.
void advance_whole(Body& body, const scene::Scene& scene, double end) {
    const Limits limits = limits_of(body, *scene.mpm, energy_of(body));
    double fastest = 0.0;
    advance(body, scene, end, [&](double) {
        require_whole(body, limits);
        fastest = std::max(fastest, body.tally.fastest);
    });
    expect_error_within("fastest point / the guard's limit", fastest / limits.speed, 1.0);
}

/// Runs and fails on a message of the guard.
Body whole_after(const scene::Scene& scene, double end) {
    Body body = filled_body(scene);
    const Energy start = energy_of(body);
    const double volume = volume_of(body.points, {1});
    const Limits limits = limits_of(body, *scene.mpm, start);
    advance_whole(body, scene, end);
    const Energy now = energy_of(body);
    const double ratio = volume_of(body.points, {1}) / volume;
    expect_error_within("energy gained / released", std::max(-numerical_share(start, now), 0.0),
                        scene.mpm->largest_energy_gain);
    expect_error_within("volume / initial volume - 1", ratio - 1.0, 1.5);
    const auto complaint = budget_complaint(limits, start, now, ratio);
    EXPECT_FALSE(complaint) << *complaint;
    return body;
}

TEST(Extremes, NearlyIncompressibleSoilStaysWhole) {
    whole_after(heap(sand(1e6, 0.4999, 1e3, 20.0)), 0.5);
}

TEST(Extremes, LiquidWithoutStrengthStaysWhole) {
    whole_after(heap(sand(1e6, 0.45, 0.0, 0.0)), 1.0);
}

TEST(Extremes, OneParticlePerCellStaysWhole) {
    scene::Scene scene = heap(sand(5e6, 0.3, 1e3, 30.0));
    scene.mpm->fill_points = 1;
    whole_after(scene, 2.0);
}

TEST(Extremes, TenGStaysWhole) {
    scene::Scene scene = heap(sand(5e6, 0.3, 1e3, 30.0));
    scene.gravity = 98.1;
    whole_after(scene, 0.6);
}

TEST(Extremes, FrictionOfZeroAndOfTenStayWhole) {
    for (const double mu : {0.0, 10.0}) {
        scene::Scene scene = heap(sand(5e6, 0.3, 1e3, 30.0));
        scene.mpm->floor.friction[0].coefficient = mu;
        whole_after(scene, 1.0);
    }
}

TEST(Extremes, StiffnessContrastOfOneHundredThousandInOneCellStaysWhole) {
    scene::Scene scene = heap(elastic(1e9, 0.3));
    scene.materials.push_back({.name = "soft", .density = 1800.0, .law = elastic(1e4, 0.3)});
    scene.section.regions[0].polygon = rectangle(0, 0, 4, 0.75);
    scene.section.regions.push_back(
        {.name = "soft", .material = 1, .polygon = rectangle(0, 0.75, 4, 1.25)});
    Body body = filled_body(scene);
    advance_whole(body, scene, 0.2);
}

TEST(Extremes, StressFarOutsideYieldIsReturned) {
    const scene::Scene scene = heap(sand(5e6, 0.3, 1e3, 30.0));
    Body body = filled_body(scene);
    for (double& s : body.points.syy) s = -1e6;
    advance_whole(body, scene, 0.5);
}

TEST(Extremes, ParticlesExactlyOnNodesAndWallsStayWhole) {
    const scene::Scene scene = heap(sand(5e6, 0.3, 1e3, 30.0));
    exchange::ParticleState state = fill_section(scene).state;
    for (auto& x : state.position) x -= mechanics::Vec2{0.125, 0.125};
    Body body = make_body(scene, zoned_points(scene, state, "test"), "test");
    advance_whole(body, scene, 0.5);
}

TEST(Extremes, ASinglePointFallsLandsAndStays) {
    scene::Scene scene =
        one_soil(sand(5e6, 0.3, 1e3, 30.0), 1800.0, rectangle(4, 2, 5, 3), 1.0, 10.0, 5.0);
    scene.gravity = 9.81;
    scene.mpm->floor.friction = {{0.0, 10.0, 0.5}};
    scene.mpm->fill_points = 1;
    Body body = filled_body(scene);
    ASSERT_EQ(body.points.size(), 1U);
    const Limits limits = limits_of(body, *scene.mpm, energy_of(body));
    advance(body, scene, 0.4, [&](double) { require_whole(body, limits); });
    // 2 %: the step is 1.6 % of the fall, and positions use the velocity at its end. The floor acts
    // from the cell above it: y = 1.5 is reached after 0.45 s.
    expect_error_within("fall in 0.4 s / (g t^2 / 2)",
                        (2.5 - body.points.y[0]) / (0.5 * 9.81 * 0.16) - 1.0, 0.02);
    advance(body, scene, 5.0, [&](double) { require_whole(body, limits); });
    EXPECT_NEAR(body.points.x[0], 4.5, 1e-9);
    EXPECT_GE(body.points.y[0], 0.0);
    EXPECT_LT(body.points.y[0], 1.0);
}

TEST(Extremes, NothingMovesInAThousandSecondsWithoutGravity) {
    scene::Scene scene =
        one_soil(sand(1e6, 0.3, 1e3, 30.0), 1800.0, rectangle(0, 0, 4, 2), 1.0, 8.0, 4.0);
    scene.mpm->fill_points = 2;
    Body body = filled_body(scene);
    const Points start = body.points;
    advance(body, scene, 1000.0);
    double farthest = 0.0;
    for (std::size_t p = 0; p < start.size(); ++p) {
        farthest = std::max({farthest, std::abs(body.points.x[p] - start.x[p]),
                             std::abs(body.points.y[p] - start.y[p])});
    }
    expect_error_within("farthest move in 1000 s", farthest, 0.0);
}

TEST(Extremes, HeapOnAValleyOfSixtyDegreesStaysWhole) {
    scene::Scene scene = one_soil(sand(5e6, 0.3, 1e3, 30.0), 1800.0,
                                  {{1.0, 16.0}, {5.0, 9.1}, {5.0, 16.0}}, 0.5, 30.0, 20.0);
    scene.gravity = 9.81;
    scene.mpm->terrain = {{0.0, 17.8}, {10.0, 0.5}, {20.0, 17.8}};
    for (const double mu : {0.0, 0.3}) {
        scene.mpm->floor.friction = {{0.0, 30.0, mu}};
        const Body body = whole_after(scene, 3.0);
        EXPECT_FALSE(ground_complaint(body)) << *ground_complaint(body);
    }
}

/// In free flight nothing limits a single point's velocity gradient: unlimited, its volume would
/// grow 3,000-fold in two seconds, count as soil, and carry nothing after landing until all of it
/// had closed.
TEST(Extremes, ATornOffPointOpensNoFurtherThanTheCellsAboutIt) {
    scene::Scene scene =
        one_soil(sand(5e6, 0.3, 1.0, 0.0), 1800.0, rectangle(4.0, 4.0, 4.25, 4.25), 0.5, 8.0, 8.0);
    scene.mpm->blending_rate = 0.0;
    Body body = filled_body(scene, [](const mechanics::Vec2& x) {
        return mechanics::Vec2{4.0 * (x.x() - 4.125), 0.0};
    });
    ASSERT_EQ(body.points.size(), 1u);
    const double cells = 4.0 * 0.5 * 0.5;
    const double V = body.points.V[0];
    advance(body, scene, 2.0);
    expect_error_within("a torn-off point's volume / the four cells about it",
                        body.points.volume[0] / cells, 1.05);
    EXPECT_GT(body.points.volume[0], 0.9 * cells);
    expect_error_within("gap against the volume's own strain",
                        body.points.gap[0] / std::log(body.points.volume[0] / V) - 1.0, 0.01);
    // Compressed again, it closes as far as it opened, then carries load and rebounds.
    body.points.Lxx[0] = body.points.Lyy[0] = -1.5;
    double volume_when_closed = 0.0;
    double lowest_stress = 0.0;
    advance(body, scene, 2.0, [&](double) {
        const Points& now = body.points;
        if (now.gap[0] == 0.0 && volume_when_closed == 0.0) volume_when_closed = now.volume[0];
        lowest_stress = std::min(lowest_stress, now.sxx[0]);
    });
    expect_error_within("volume when all is closed, against what it was",
                        volume_when_closed / V - 1.0, 0.05);
    EXPECT_LT(lowest_stress, -1e3);
}

}  // namespace
}  // namespace breach::mpm::test::extremes_test
