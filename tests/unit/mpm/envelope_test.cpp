// The envelope over x and the hydrographs at sections.
#include "mpm_solver/measure/envelope.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mpm_solver/checkpoint.hpp"
#include "mpm_solver/measure/sections.hpp"
#include "mpm_solver/simulation.hpp"
#include "tests/folder.hpp"
#include "tests/unit/mpm/bodies.hpp"

namespace breach::mpm::test {
namespace {

std::vector<Flow> depths(std::initializer_list<double> values, double velocity = 2.0) {
    std::vector<Flow> profile;
    for (const double depth : values) profile.push_back({depth, velocity, depth > 0.0 ? 8 : 0});
    return profile;
}

TEST(Envelope, KeepsTheLargestAndWhenItCame) {
    Envelope envelope;
    envelope.see(0.0, depths({2.0, 0.0, 0.0}), 0.5);
    envelope.see(1.0, depths({1.5, 1.0, 0.0}, -3.0), 0.5);
    envelope.see(2.0, depths({1.0, 3.0, 0.0}), 0.5);
    envelope.see(2.0, depths({9.0, 9.0, 9.0}), 0.5);  // already sampled
    EXPECT_EQ(envelope.depth, (std::vector<double>{2.0, 3.0, 0.0}));
    EXPECT_EQ(envelope.velocity, (std::vector<double>{3.0, 3.0, 0.0}));
    EXPECT_EQ(envelope.flux, (std::vector<double>{13.5, 12.0, 0.0}));
    EXPECT_EQ(envelope.arrival, (std::vector<double>{0.0, 0.5, Envelope::never}));
    EXPECT_EQ(envelope.time_of_peak, (std::vector<double>{0.0, 2.0, Envelope::never}));
}

TEST(Envelope, GrainsAreNoFlow) {
    std::vector<Flow> profile{{0.25, 5.0, 1}, {0.5, 5.0, 2}, {0.5, 5.0, 3}};
    profile = without_grains(std::move(profile));
    EXPECT_EQ(profile[0].depth, 0.0);
    EXPECT_EQ(profile[1].velocity, 0.0);
    EXPECT_EQ(profile[2].depth, 0.5);
}

TEST(Envelope, VelocitiesAreThoseOfAFlow) {
    Envelope envelope;
    envelope.see(0.0, {{0.0, 0.0, 0}}, 0.1);
    envelope.see(1.0, {{0.006, 16.9, 3}}, 0.1);  // ahead of the front
    EXPECT_EQ(envelope.velocity[0], 0.0) << "as it has not arrived";
    envelope.see(2.0, {{0.2, -4.9, 8}}, 0.1);
    EXPECT_EQ(envelope.velocity[0], 4.9);
}

TEST(Envelope, KeepsABoundedNumberOfRowsOfEvenTimes) {
    Envelope envelope;
    for (int k = 0; k <= 5000; ++k) envelope.see(0.01 * k, depths({0.01 * k, 1.0}), 0.5);
    const std::vector<double>& times = envelope.row_times;
    ASSERT_LE(times.size(), most_rows);
    ASSERT_GE(times.size(), most_rows / 2);
    ASSERT_EQ(envelope.row_depths.size(), 2 * times.size());
    for (std::size_t row = 0; row < times.size(); ++row)
        EXPECT_EQ(envelope.row_depths[2 * row], times[row]);
    for (std::size_t row = 2; row < times.size(); ++row)
        EXPECT_NEAR(times[row] - times[row - 1], times[1] - times[0], 0.02);
    EXPECT_GT(times.back(), 49.0);
}

/// 2.5 m deep from x = 2 to 6.
scene::Scene low_layer() {
    return one_soil(elastic(1e6, 0.3), 2000.0, rectangle(2, 0, 6, 2.5), 1.0, 12.0, 6.0);
}

void move(Points& points, double by) {
    for (double& x : points.x) x += by;
}

TEST(Sections, WhatPassesARigidLayerIsItsDepthTimesItsWay) {
    const scene::Scene scene = low_layer();
    static constexpr double v = 3.0;
    Body body = filled_body(scene, [](const Vec2&) -> Vec2 { return {v, 0.0}; });
    const FlowView view = flow_view(scene, body.grid);
    // Downstream, at the edge, inside, upstream; nothing can pass the grid's ends.
    const std::vector<scene::FlowSection> sections{{"down", 8.0}, {"edge", 6.0}, {"in", 4.3},
                                                   {"up", 1.0},   {"low", 0.0},  {"high", 12.0}};
    SectionRecords records;
    double time = 0.0;
    for (int k = 0; k <= 200; ++k, time += 0.005) {  // 3 m in all
        sample_sections(sections, body, view, time, records);
        if (k % 20 == 0)
            read_sections(sections, body.points, view, time, k == 0 ? time : time - 0.1, records);
        move(body.points, v * 0.005);
        body.strips.sort(body.grid, body.points, body.zones);
    }
    const std::vector<double> passed{2.5, 7.5, 5.75, 0.0, 0.0, 0.0};
    for (std::size_t s = 0; s < sections.size(); ++s) {
        double sum = 0.0;
        for (const double q : records[s].discharge) sum += 0.1 * q;
        EXPECT_NEAR(sum, records[s].volume.back(), 1e-12) << sections[s].name;
        EXPECT_NEAR(records[s].volume.back(), passed[s], 1e-9) << sections[s].name;
        EXPECT_NEAR(records[s].mass.back(), 2000.0 * records[s].volume.back(), 1e-8);
        const auto closure = closure_of(records[s]);
        EXPECT_EQ(closure.has_value(), passed[s] > 0.0) << sections[s].name;
        // Between two samples the layer moves 15 mm, of the 2.5 m2 that pass; half of that at its
        // edges.
        EXPECT_NEAR(closure.value_or(0.0), 0.0, 0.016) << sections[s].name;
    }
    EXPECT_NEAR(records[1].discharge.back(), 7.5, 1e-9);
    std::vector<double> times;
    for (int k = 0; k <= 10; ++k) times.push_back(0.1 * k);
    const auto peak = peak_of(records[1], times, view, 0.1);
    ASSERT_TRUE(peak);
    EXPECT_NEAR(peak->window, 2.0 / v, 1e-12);
    EXPECT_NEAR(peak->discharge, 7.5, 1e-9);
    EXPECT_FALSE(peak_of(records[3], times, view, 0.1));
    records[1].velocity.front() = 10.0 * v;  // of almost no soil
    records[1].depth.front() = 0.01;
    EXPECT_NEAR(peak_of(records[1], times, view, 0.1)->window, 2.0 / v, 1e-12);
    EXPECT_NEAR(peak_of(records[1], times, view, 9.0)->window, 0.2 / v, 1e-12)
        << "of a flow that is never so deep";
}

TEST(Sections, SoilThatGoesBackIsNegative) {
    const scene::Scene scene = low_layer();
    Body body = filled_body(scene);
    const FlowView view = flow_view(scene, body.grid);
    const std::vector<scene::FlowSection> sections{{"in", 4.0}};
    SectionRecords records;
    read_sections(sections, body.points, view, 0.0, 0.0, records);
    move(body.points, -1.0);
    read_sections(sections, body.points, view, 2.0, 0.0, records);
    EXPECT_NEAR(records[0].volume.back(), -2.5, 1e-12);
    EXPECT_NEAR(records[0].discharge.back(), -1.25, 1e-12);
}

scene::Scene watched_heap() {
    scene::Scene scene = sand_block();
    scene.mpm->arrival_depth = 0.2;
    scene.mpm->sections = {{"toe", 4.0}, {"far", 5.0}, {"end", 20.0}};
    return scene;
}

Simulation run(const scene::Scene& scene, std::int64_t steps, int threads = 1) {
    Body body = make_body(scene, zoned_points(scene, fill_section(scene).state, "test"), "test",
                          {.threads = threads});
    Simulation simulation(scene, std::move(body), 0.0);
    simulation.look();
    for (std::int64_t k = 0; k < steps; ++k) {
        simulation.advance();
        if (simulation.look_due()) simulation.look();
    }
    return simulation;
}

void expect_same(const Records& a, const Records& b) {
    EXPECT_EQ(a.envelope.depth, b.envelope.depth);
    EXPECT_EQ(a.envelope.velocity, b.envelope.velocity);
    EXPECT_EQ(a.envelope.flux, b.envelope.flux);
    EXPECT_EQ(a.envelope.arrival, b.envelope.arrival);
    EXPECT_EQ(a.envelope.time_of_peak, b.envelope.time_of_peak);
    EXPECT_EQ(a.envelope.row_times, b.envelope.row_times);
    EXPECT_EQ(a.envelope.row_depths, b.envelope.row_depths);
    ASSERT_EQ(a.sections.size(), b.sections.size());
    for (std::size_t s = 0; s < a.sections.size(); ++s) {
        EXPECT_EQ(a.sections[s].by_momentum, b.sections[s].by_momentum);
        EXPECT_EQ(a.sections[s].discharge, b.sections[s].discharge);
        EXPECT_EQ(a.sections[s].volume, b.sections[s].volume);
    }
}

TEST(Envelope, HasTheSameBitsForAnyThreadsAndAfterAStop) {
    const scene::Scene scene = watched_heap();
    const Simulation whole = run(scene, 300);
    expect_same(whole.records(), run(scene, 300, 2).records());

    const exchange::Provenance provenance{
        .phase = "mpm_solver", .version = "0", .scene = "{}", .overrides = {}, .inputs = {}};
    const breach::test::Folder folder;
    const auto file = folder / "checkpoint.h5";
    save_checkpoint(file, run(scene, 141), 1, provenance);
    Resumed resumed = load_checkpoint(file, scene, provenance);
    for (int k = 141; k < 300; ++k) {
        resumed.simulation.advance();
        if (resumed.simulation.look_due()) resumed.simulation.look();
    }
    expect_same(whole.records(), resumed.simulation.records());
}

// The flux of the collapse through a section equals the volume beyond it, to 1 % at the toe.
TEST(Sections, OfACollapseClose) {
    scene::Scene scene = watched_heap();
    scene.mpm->cell_size = 0.25;
    const Simulation simulation = run(scene, 2000);
    const SectionRecords& sections = simulation.records().sections;
    for (const std::size_t s : {0U, 1U}) {
        ASSERT_GT(sections[s].volume.back(), 0.5);
        // A thin front of few points at x = 5: 1.3 %.
        EXPECT_LT(std::abs(*closure_of(sections[s])), s == 0 ? 0.01 : 0.02) << s;
    }
    EXPECT_FALSE(closure_of(sections[2]));
    double beyond_toe = 0.0;
    const Points& points = simulation.body().points;
    for (std::size_t p = 0; p < points.size(); ++p)
        if (points.x[p] > 4.0) beyond_toe += points.V_0[p];
    // Points counted whole: the error is the volume of those on the section.
    EXPECT_NEAR(sections[0].volume.back(), beyond_toe, 0.05 * beyond_toe);
}

}  // namespace
}  // namespace breach::mpm::test
