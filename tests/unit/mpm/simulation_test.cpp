#include "mpm_solver/simulation.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "mpm_solver/begin.hpp"
#include "mpm_solver/checkpoint.hpp"
#include "tests/folder.hpp"
#include "tests/unit/mpm/bodies.hpp"

namespace breach::mpm::test {
namespace {

scene::Scene heap() {
    scene::Scene scene = sand_block();
    scene.mpm->snapshot_interval = 0.25;
    scene.mpm->runout.toe = {4.0, 0.0};
    return scene;
}

const exchange::Provenance of_no_input{
    .phase = "mpm_solver", .version = "0", .scene = "{}", .overrides = {}, .inputs = {}};

Simulation fresh(const scene::Scene& scene) { return {scene, filled_body(scene), 0.0}; }

/// As after a transfer with water.
Simulation fresh_and_wet(const scene::Scene& scene) {
    exchange::ParticleState state = fill_section(scene).state;
    for (std::size_t p = 0; p < state.size(); ++p)
        state.r_u.push_back(0.001 * static_cast<double>(p));
    state.stress_of_regions = {exchange::StressMeasure::total};
    return {scene, make_body(scene, zoned_points(scene, state, "test"), "test"), 0.0};
}

void advance_looking(Simulation& simulation, std::int64_t steps) {
    for (std::int64_t k = 0; k < steps; ++k) {
        simulation.advance();
        if (simulation.look_due()) simulation.look();
        if (simulation.frame_due()) simulation.take_frame();
    }
}

void expect_same_bits(const Simulation& a, const Simulation& b) {
    EXPECT_EQ(a.clock().time, b.clock().time);
    EXPECT_EQ(a.clock().dt_min, b.clock().dt_min);
    EXPECT_EQ(a.body().tally.plastic, b.body().tally.plastic);
    EXPECT_EQ(a.body().tally.friction, b.body().tally.friction);
    EXPECT_EQ(a.body().tally.viscous, b.body().tally.viscous);
    EXPECT_EQ(a.body().tally.pushed_in, b.body().tally.pushed_in);
    std::vector<const std::vector<double>*> arrays;
    for_each_real(a.body().points,
                  [&](const char*, const auto& values) { arrays.push_back(&values); });
    std::size_t k = 0;
    for_each_real(b.body().points, [&](const char* name, const auto& values) {
        EXPECT_TRUE(*arrays[k++] == values) << name;
    });
    EXPECT_EQ(a.state().r_u, b.state().r_u);
    EXPECT_EQ(a.state().stress_of_regions, b.state().stress_of_regions);
    ASSERT_EQ(a.records().history.size(), b.records().history.size());
    EXPECT_EQ(a.records().history.back().energy_numerical,
              b.records().history.back().energy_numerical);
}

TEST(Resume, IsBitIdenticalToAnUninterruptedRun) {
    scene::Scene scene = heap();
    scene.materials[0].viscosity = 100.0;
    scene.mpm->overlap_correction = {.rate = 5.0, .tolerance = 0.0};
    const exchange::Provenance& provenance = of_no_input;
    const breach::test::Folder folder;
    const auto file = folder / "checkpoint.h5";
    Simulation whole = fresh_and_wet(scene);
    Simulation stopped = fresh_and_wet(scene);
    advance_looking(whole, 137);
    advance_looking(stopped, 137);
    save_checkpoint(file, stopped, 42, provenance);
    Resumed resumed = load_checkpoint(file, scene, provenance);
    EXPECT_EQ(resumed.telemetry_lines, 42);
    advance_looking(whole, 200);
    advance_looking(resumed.simulation, 200);
    expect_same_bits(whole, resumed.simulation);

    exchange::Provenance other = provenance;
    other.scene = "{\"name\":\"other\"}";
    EXPECT_THROW(load_checkpoint(file, scene, other), fault::BadInput);
}

/// Enough points for two threads; they soften within the first hundred steps.
scene::Scene brittle_heap() {
    scene::Scene scene = heap();
    scene.mpm->cell_size = 0.16;
    std::get<materials::MohrCoulomb>(scene.materials[0].law).softening =
        materials::Softening{.epsilon_q_start = 0.0,
                             .epsilon_q_end = 0.05,
                             .c_residual = 100.0,
                             .tan_phi_residual = 0.2};
    scene.materials[0].nonlocal_length = 0.4;
    return scene;
}

Simulation fresh_by(int threads, const scene::Scene& scene) {
    ZonedPoints points = zoned_points(scene, fill_section(scene).state, "test");
    return {scene, make_body(scene, std::move(points), "test", {.threads = threads}), 0.0};
}

/// Two threads and a stop after 150 of 300 steps change no bit. `fresh`: by number of threads.
/// Returns the uninterrupted run of one thread; the checkpoint stays in `file`.
Simulation same_after_a_stop(const scene::Scene& scene, const std::filesystem::path& file,
                             Simulation (*fresh)(int, const scene::Scene&)) {
    Simulation whole = fresh(1, scene);
    EXPECT_GT(whole.body().points.size(), 2000U) << "too few for two threads";
    Simulation stopped = fresh(2, scene);
    advance_looking(whole, 150);
    advance_looking(stopped, 150);
    expect_same_bits(whole, stopped);
    save_checkpoint(file, stopped, 42, of_no_input);
    Resumed resumed = load_checkpoint(file, scene, of_no_input, {.threads = 2});
    advance_looking(whole, 150);
    advance_looking(resumed.simulation, 150);
    expect_same_bits(whole, resumed.simulation);
    return whole;
}

TEST(NonlocalRun, HasTheSameBitsForTwoThreadsAndAfterAStop) {
    scene::Scene scene = brittle_heap();
    const breach::test::Folder folder;
    const Simulation whole = same_after_a_stop(scene, folder / "checkpoint.h5", fresh_by);

    scene.materials[0].nonlocal_length.reset();
    Simulation local = fresh_by(1, scene);
    advance_looking(local, 300);
    EXPECT_NE(local.body().points.epsilon_q_plastic, whole.body().points.epsilon_q_plastic);
}

/// Half under water, whose pressure in the soil is that of a mesh and not of the line.
Simulation fresh_in_water(int threads, const scene::Scene& scene) {
    const mechanics::NodalField steady{
        .position = {{0, 0}, {5, 0}, {5, 3}, {0, 3}}, .quads = {{0, 1, 2, 3}}, .value = {}};
    exchange::ParticleState state = fill_section(scene).state;
    state.steady_pressure = steady;
    state.steady_pressure.value = {25e3, 20e3, 0.0, 0.0};
    return {scene,
            make_body(scene, zoned_points(scene, state, "test"), "test", {.threads = threads},
                      state.steady_pressure),
            0.0};
}

TEST(RunInWater, HasTheSameBitsForTwoThreadsAndAfterAStop) {
    scene::Scene scene = brittle_heap();
    scene.mpm->water = {{{0.0, 2.0}}, 1000.0};
    const breach::test::Folder folder;
    const auto file = folder / "checkpoint.h5";
    const Simulation whole = same_after_a_stop(scene, file, fresh_in_water);
    Simulation by_line{scene, filled_body(scene), 0.0};
    advance_looking(by_line, 300);
    EXPECT_NE(whole.body().points.x, by_line.body().points.x) << "the mesh's pressure counts";

    scene.mpm->water.reset();
    EXPECT_THROW(load_checkpoint(file, scene, of_no_input), fault::BadInput);
}

TEST(RunInWater, TakesOnlyPointsThatWereMadeForIt) {
    scene::Scene scene = heap();
    exchange::ParticleState state = fill_section(scene).state;
    state.stress_of_regions = {exchange::StressMeasure::buoyant};
    EXPECT_THROW(zoned_points(scene, state, "test"), fault::BadInput);
    scene.mpm->water = {{{0.0, 2.0}}, 1000.0};
    EXPECT_NO_THROW(zoned_points(scene, state, "test"));
    state.stress_of_regions = {exchange::StressMeasure::total};
    EXPECT_THROW(zoned_points(scene, state, "test"), fault::BadInput);
}

/// 0.3 g at 2 Hz for 1.2 s from the transfer at 0.4 s on.
GroundMotion shaking_ground() {
    exchange::BaseMotion base{.time_step = 0.01, .velocity = {}};
    for (int k = 0; k <= 160; ++k)
        base.velocity.push_back(0.24 * std::sin(4.0 * std::numbers::pi * 0.01 * k));
    return {base, 0.4};
}

Simulation fresh_and_shaken(const scene::Scene& scene) {
    exchange::ParticleState state = fill_section(scene).state;
    stand_on_ground(shaking_ground(), state);
    return {scene, make_body(scene, zoned_points(scene, state, "test"), "test"), 0.4,
            shaking_ground()};
}

TEST(ShakenRun, GoesOnAfterAStopWithTheSameBits) {
    scene::Scene scene = heap();
    scene.mpm->shaking = scene::Shaking::goes_on;
    const exchange::Provenance& provenance = of_no_input;
    const breach::test::Folder folder;
    const auto file = folder / "checkpoint.h5";
    Simulation whole = fresh_and_shaken(scene);
    Simulation stopped = fresh_and_shaken(scene);
    advance_looking(whole, 137);
    advance_looking(stopped, 137);
    ASSERT_LT(stopped.clock().time, 1.0);
    save_checkpoint(file, stopped, 42, provenance);
    Resumed resumed = load_checkpoint(file, scene, provenance);
    advance_looking(whole, 200);
    advance_looking(resumed.simulation, 200);
    expect_same_bits(whole, resumed.simulation);
    EXPECT_EQ(whole.body().tally.shaking, resumed.simulation.body().tally.shaking);
    EXPECT_NE(whole.body().tally.shaking, 0.0);

    scene.mpm->shaking = scene::Shaking::off;
    try {
        load_checkpoint(file, scene, provenance);
        FAIL() << "half a run on moving ground";
    } catch (const fault::BadInput& bad) {
        ASSERT_EQ(bad.faults().size(), 1U);
        EXPECT_EQ(bad.faults()[0].pointer, "/mpm/shaking");
        EXPECT_NE(bad.faults()[0].remedy.find("/mpm/shaking=on"), std::string::npos);
    }
    Simulation still = fresh(scene);
    advance_looking(still, 10);
    save_checkpoint(file, still, 1, provenance);
    scene.mpm->shaking = scene::Shaking::goes_on;
    EXPECT_THROW(load_checkpoint(file, scene, provenance), fault::BadInput);
}

TEST(ShakenRun, IsNotAtRestBeforeTheGroundIs) {
    scene::Scene scene = heap();
    scene.materials[0].law = elastic(5e6, 0.3);
    scene.mpm->rest.earliest = 0.1;
    scene.mpm->rest.window = 0.1;
    const Simulation shaken = fresh_and_shaken(scene);
    EXPECT_DOUBLE_EQ(shaken.rest().earliest, shaking_ground().end());
    EXPECT_DOUBLE_EQ(fresh(scene).rest().earliest, 0.1);
}

TEST(ShakenRun, StandsOnTheGroundWithTheMomentumThatItHad) {
    const scene::Scene scene = heap();
    exchange::ParticleState state = fill_section(scene).state;
    for (std::size_t p = 0; p < state.size(); ++p)
        state.velocity[p] = {0.5 + 0.01 * static_cast<double>(p % 7), -0.25};
    const auto momentum = [&] {
        mechanics::Vec2 sum = mechanics::Vec2::Zero();
        for (std::size_t p = 0; p < state.size(); ++p) sum += state.mass[p] * state.velocity[p];
        return sum;
    };
    double mass = 0.0;
    for (const double m : state.mass) mass += m;
    const mechanics::Vec2 before = momentum();
    const double v_ground = shaking_ground().velocity(0.0);
    ASSERT_GT(std::abs(v_ground), 0.1);
    const std::vector<mechanics::Vec2> places = state.position;
    stand_on_ground(shaking_ground(), state);
    EXPECT_EQ(state.position[7].x(), places[7].x() - shaking_ground().displacement(0.0));
    EXPECT_EQ(state.position[7].y(), places[7].y());
    const mechanics::Vec2 after = momentum();
    EXPECT_NEAR(after.x() + mass * v_ground, before.x(), 1e-12 * before.norm());
    EXPECT_EQ(after.y(), before.y());
}

// Ground at rest changes no bit.
TEST(ShakenRun, OnGroundAtRestHasTheBitsOfARunWithout) {
    const scene::Scene scene = heap();
    Simulation without = fresh(scene);
    Simulation with(scene, filled_body(scene), 0.0,
                    GroundMotion({.time_step = 0.1, .velocity = {0.2, 0.2, 0.2}}, 0.0));
    advance_looking(without, 150);
    advance_looking(with, 150);
    expect_same_bits(without, with);
    EXPECT_EQ(with.body().tally.shaking, 0.0);
}

TEST(Simulation, HitsSnapshotTimesExactly) {
    const scene::Scene scene = heap();
    Simulation simulation = fresh(scene);
    std::vector<double> times;
    while (simulation.clock().time < 1.0) {
        if (simulation.frame_due()) {
            times.push_back(simulation.clock().time);
            simulation.take_frame();
        }
        simulation.advance();
    }
    EXPECT_EQ(times, (std::vector<double>{0.0, 0.25, 0.5, 0.75}));
}

TEST(Simulation, AGridTooSmallIsABreakdownThatSaysWhere) {
    scene::Scene scene = heap();
    scene.mpm->domain_x = {0.0, 5.0};
    Simulation simulation = fresh(scene);
    try {
        advance_looking(simulation, 100000);
        FAIL() << "nothing stopped it";
    } catch (const fault::Breakdown& breakdown) {
        const std::string text = breakdown.what();
        EXPECT_NE(text.find("right end of the grid"), std::string::npos) << text;
        EXPECT_NE(text.find("t = "), std::string::npos) << text;
    }
    const exchange::ParticleState good = simulation.last_good_state();
    for (const auto& x : good.position) EXPECT_LE(x.x(), 5.0);
    EXPECT_GT(good.time, 0.0);
}

TEST(LastGoodState, IsThatOfEveryPointInAnyLaterOrder) {
    Body body = filled_body(heap());
    Points& points = body.points;
    std::vector<double> x(points.size());
    std::vector<double> gap(points.size());
    for (std::size_t p = 0; p < points.size(); ++p) {
        points.gap[p] = 0.25 * points.number[p];
        x[points.number[p]] = points.x[p];
        gap[points.number[p]] = points.gap[p];
    }
    const LastGood good(points, 0.5, 7);
    const std::vector<std::int32_t> order = points.number;
    for (double& each : points.x) each = 4.0 - each;
    for (double& each : points.gap) each = 0.0;
    body.strips.sort(body.grid, points, body.zones);
    ASSERT_NE(points.number, order);
    const Points then = good.restored(points);
    for (std::size_t p = 0; p < then.size(); ++p) {
        EXPECT_EQ(then.x[p], static_cast<float>(x[then.number[p]]));
        EXPECT_EQ(then.gap[p], gap[then.number[p]]);
    }
}

/// A checkpoint modified by another program.
class ChangedCheckpoint : public testing::Test {
  protected:
    ChangedCheckpoint() : scene_(heap()) {
        save_checkpoint(file_, fresh(scene_), 0, provenance_);
        archive_ = exchange::read_archive(file_, "mpm_checkpoint", checkpoint_version);
    }

    void expect_refused(const std::string& where) {
        exchange::write_archive(file_, archive_, provenance_);
        try {
            load_checkpoint(file_, scene_, provenance_);
            FAIL() << where << " was taken";
        } catch (const fault::BadInput& refusal) {
            EXPECT_EQ(refusal.faults().at(0).pointer, where);
        }
    }

    const breach::test::Folder folder_;
    const std::filesystem::path file_ = folder_ / "checkpoint.h5";
    const exchange::Provenance provenance_{};
    const scene::Scene scene_;
    exchange::Archive archive_;
};

TEST_F(ChangedCheckpoint, WithAShortArrayIsRefused) {
    archive_.reals.at("sxy").pop_back();
    expect_refused("/sxy");
}

TEST_F(ChangedCheckpoint, WithoutPointsIsRefused) {
    archive_.reals.at("x").clear();
    expect_refused("/x");
}

TEST_F(ChangedCheckpoint, WithAnUnknownSoilIsRefused) {
    archive_.integers.at("region").back() = 1;
    expect_refused("/region");
}

TEST_F(ChangedCheckpoint, WithAPointThatIsNotThereIsRefused) {
    archive_.integers.at("number").front() = 1 << 20;
    expect_refused("/number");
}

TEST_F(ChangedCheckpoint, WithAHomeOutsideTheGridIsRefused) {
    archive_.integers.at("home").back() = 1 << 20;
    expect_refused("/home");
}

TEST_F(ChangedCheckpoint, WithAPointOutsideTheGridIsRefused) {
    archive_.reals.at("x").front() = 1e300;
    expect_refused("/x");
}

TEST_F(ChangedCheckpoint, WithAPointFarFromItsHomeIsRefused) {
    archive_.integers.at("home").front() = archive_.integers.at("home").back();
    expect_refused("/home");
}

TEST_F(ChangedCheckpoint, WithLooksOfWhichThereIsNoRecordIsRefused) {
    archive_.integers.at("run.looks") = {1};
    expect_refused("/run.looks");
}

TEST_F(ChangedCheckpoint, WithAMeasureOfStressThatIsNoneIsRefused) {
    archive_.integers["stress_of_soils"] = {3};
    expect_refused("/stress_of_soils");
}

TEST_F(ChangedCheckpoint, WithACountThatCannotGoOnIsRefused) {
    archive_.integers.at("run.step") = {std::numeric_limits<std::int64_t>::max()};
    expect_refused("/run.step");
}

TEST(Simulation, AStepFarTooLargeIsABreakdownNotAResult) {
    scene::Scene scene = heap();
    scene.mpm->time_step = 0.02;  // CFL 2.3
    Simulation simulation = fresh(scene);
    EXPECT_THROW(advance_looking(simulation, 2000), fault::Breakdown);
}

TEST(Simulation, ABlockThatStandsHasNoLargeShareOfNumericalEnergy) {
    scene::Scene scene = heap();
    scene.materials[0].law = sand(5e9, 0.3, 1e6, 30.0);
    Simulation standing = fresh(scene);
    advance_looking(standing, 200);
    const Row row = standing.look();
    const double scale = standing.scale_of_energy();
    const double fallen =
        standing.start().energy.gravitational - energy_of(standing.body()).gravitational;
    EXPECT_LT(std::abs(fallen), 1e-2 * scale);
    EXPECT_EQ(row.energy_numerical_share, row.energy_numerical / scale);
    EXPECT_LT(std::abs(row.energy_numerical_share), 1e-2);
}

/// The wall pressure along the floor exceeds friction: no sliding there.
TEST(Simulation, SoilBetweenWallsRubsNothingAtTheirFeet) {
    scene::Scene scene =
        one_soil(sand(1e7, 0.49, 50e3, 25.0), 1800.0, rectangle(0, 0, 10, 10), 1.0, 10.0, 14.0);
    scene.gravity = 9.81;
    scene.mpm->fill_stress = scene::FillStress::overburden;
    scene.mpm->left = scene.mpm->right = scene::Wall::roller;
    scene.mpm->floor.friction = {{0.0, 10.0, 0.2}};
    Simulation standing = fresh(scene);
    while (standing.clock().time < 1.0) advance_looking(standing, 1);
    const double released = 1e-3 * 1800.0 * 100.0 * 9.81 * 5.0;  // 0.1 % of the possible energy
    EXPECT_LT(standing.look().friction_dissipation, released);
}

TEST(Simulation, StopsAtRestAndSaysSo) {
    const scene::Scene scene = heap();
    Simulation simulation = fresh(scene);
    while (simulation.course() == Course::goes_on) advance_looking(simulation, 1);
    EXPECT_EQ(simulation.course(), Course::rests);
    EXPECT_LT(simulation.clock().time, 10.0);
}

TEST(Simulation, EndsAtDurationWhenItDoesNotRest) {
    scene::Scene scene = heap();
    scene.mpm->duration = 0.3;
    Simulation simulation = fresh(scene);
    while (simulation.course() == Course::goes_on) advance_looking(simulation, 1);
    EXPECT_EQ(simulation.course(), Course::time_is_up);
    EXPECT_NEAR(simulation.clock().time, 0.3, 1e-12);
}

}  // namespace
}  // namespace breach::mpm::test
