// When a run may end, and messages if it ended too early.
#include "mpm_solver/measure/rest.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "mpm_solver/measure/ending_flags.hpp"
#include "mpm_solver/simulation.hpp"
#include "tests/unit/mpm/bodies.hpp"

namespace breach::mpm::test {
namespace {

using testing::HasSubstr;

/// A criterion by the percentiles of x alone.
bool front_stands(const History& history, const scene::Rest& rest) {
    const Row& now = history.back();
    const double from = now.time - rest.window;
    if (now.time < rest.earliest || from < history.front().time) return false;
    for (auto row = history.rbegin(); row != history.rend(); ++row) {
        if (std::abs(row->runout - now.runout) > rest.change ||
            std::abs(row->runout_beyond_toe - now.runout_beyond_toe) > rest.change) {
            return false;
        }
        if (row->time <= from) break;
    }
    return true;
}

/// Blocks of one soil without loads, 1 m cells with four points each.
scene::Scene blocks() {
    scene::Scene scene =
        one_soil(elastic(1e6, 0.3), 2000.0, rectangle(2, 2, 6, 6), 1.0, 40.0, 10.0);
    scene.section.regions.push_back(
        {.name = "front", .material = 0, .polygon = rectangle(20, 2, 24, 6)});
    return scene;
}

void advance_to(Simulation& simulation, double end) {
    simulation.look();
    while (simulation.clock().time < end && simulation.course() == Course::goes_on) {
        simulation.advance();
        if (simulation.look_due()) simulation.look();
    }
}

TEST(Rest, IsNotYetThereWhileAMassMovesBehindAFrontThatStandsStill) {
    const scene::Scene scene = blocks();
    Body body = filled_body(scene, [](const mechanics::Vec2& x) {
        return mechanics::Vec2{x.x() < 10.0 ? 0.5 : 0.0, 0.0};
    });
    Simulation simulation(scene, std::move(body), 0.0);
    advance_to(simulation, 4.0);
    EXPECT_TRUE(front_stands(simulation.records().history, scene.mpm->rest));
    ASSERT_EQ(simulation.course(), Course::goes_on) << "half of the soil moves at 0.5 m/s";
    EXPECT_THAT(*simulation.moving(), HasSubstr("kinetic energy"));
}

/// A row every 0.1 s to `end`, with the kinetic energy of a rule and a front at 0.
template <class Kinetic>
History history_to(double end, Kinetic kinetic) {
    History history;
    for (int k = 0; k <= std::lround(10.0 * end); ++k)
        history.push_back({.time = 0.1 * k, .kinetic_mobile = kinetic(0.1 * k)});
    return history;
}

struct RestRule : testing::Test {
    scene::Scene scene = blocks();
    Body body = filled_body(scene);
    std::vector<std::uint8_t> all{1, 1};
    Energy start{.gravitational = 1e6};  // a row without energy has released all of it

    std::optional<std::string> reason(const History& history) {
        return why_moving(history, start, body, all, scene.mpm->rest);
    }
};

TEST_F(RestRule, NeedsAStillFrontOverTheWholeWindow) {
    History history;
    for (int k = 0; k <= 100; ++k) {
        const double t = 0.1 * k;
        history.push_back({.time = t, .runout = std::min(t, 4.0), .runout_beyond_toe = 1.0});
        EXPECT_EQ(!reason(history), t > 5.94) << t;  // 2 s after 3.95 m was passed
    }
}

TEST_F(RestRule, AMassThatGathersSpeedIsNotAtRestThoughItHasHardlyAny) {
    const History history = history_to(6.0, [](double t) { return 10.0 * t * t; });
    EXPECT_LT(history.back().kinetic_mobile, 0.005 * 1e6);
    EXPECT_TRUE(front_stands(history, scene.mpm->rest));
    ASSERT_TRUE(reason(history));
    EXPECT_THAT(*reason(history), HasSubstr("of its peak"));
}

TEST_F(RestRule, KineticEnergyMustBeLowOverTheWholeWindowNotAtATurningPoint) {
    const History swings = history_to(20.0, [](double t) {
        const double v = std::sin(3.0 * t);
        return 2e5 * v * v;
    });
    EXPECT_TRUE(reason(swings));
    const History calms = history_to(20.0, [](double t) { return 2e5 * std::exp(-t); });
    EXPECT_FALSE(reason(calms)) << *reason(calms);
}

TEST_F(RestRule, ASlopeThatReleasesNothingMayRingAndMustNotGatherSpeed) {
    start = {};
    const auto of_all_at = [&](double v) { return 0.5 * mass_of(body.points, all) * v * v; };
    const auto rings = [&](double t) { return of_all_at(0.02 * std::sin(9.0 * t)); };
    EXPECT_FALSE(reason(history_to(6.0, rings)));
    EXPECT_TRUE(reason(history_to(6.0, [&](double) { return of_all_at(0.06); })));
    EXPECT_TRUE(reason(history_to(3.5, [&](double t) { return of_all_at(0.01 * t); })));
}

TEST_F(RestRule, AConnectedBodyThatMovesIsMotionAndSingleGrainsAreNot) {
    const auto quick = [&](double x_0, double x_1, double v) {
        for (std::size_t p = 0; p < body.points.size(); ++p) {
            const double x = body.points.x[p];
            if (x > x_0 && x < x_1 && body.points.y[p] < 3.0) body.points.vx[p] = v;
        }
    };
    const History history = history_to(6.0, [](double) { return 0.0; });
    quick(2.0, 2.5, 0.04);  // two points of 128, too slow
    EXPECT_FALSE(reason(history));
    quick(2.0, 2.5, 0.2);
    ASSERT_TRUE(reason(history));
    EXPECT_THAT(*reason(history), HasSubstr("connected body of 1.6 % of it around x = 2.25 m"));
    scene.mpm->rest.body_share = 0.02;
    EXPECT_FALSE(reason(history));
    quick(23.5, 24.0, 0.2);  // as many far away: no connection, no larger body
    EXPECT_FALSE(reason(history));
    quick(2.0, 3.5, 0.2);  // next to the first, in the adjacent cell
    EXPECT_TRUE(reason(history));
    EXPECT_NEAR(heaviest_moving_body(body, all, 0.05).mass, 6.0 * 500.0, 1e-6);
    EXPECT_EQ(heaviest_moving_body(body, {0, 1}, 0.05).mass, 2.0 * 500.0) << "of mobile soil only";
}

TEST(Rest, ComesToAHeapThatSlidesAndToALayerThatReleasesNothing) {
    for (const double width : {4.0, 20.0}) {
        scene::Scene scene =
            one_soil(sand(5e6, 0.3, 1e3, 30.0), 1800.0, rectangle(0, 0, width, 4), 0.5, 20.0, 6.0);
        scene.gravity = 9.81;
        scene.mpm->left = scene::Wall::roller;
        scene.mpm->right = scene::Wall::roller;
        scene.mpm->floor.friction = {{0.0, 20.0, 0.5}};
        scene.mpm->fill_stress = scene::FillStress::overburden;
        Simulation simulation(scene, filled_body(scene), 0.0);
        advance_to(simulation, 20.0);
        ASSERT_EQ(simulation.course(), Course::rests) << *simulation.moving();
        EXPECT_GE(simulation.clock().time, scene.mpm->rest.earliest);
        EXPECT_LT(simulation.last_row().kinetic_mobile, 0.005 * simulation.scale_of_energy());
    }
}

Ending sound() {
    return {.time = 12.0,
            .moving = {},
            .kinetic_share = 0.001,
            .numerical_share = 0.02,
            .stood = false,
            .correction_share = 0.04,
            .volume_ratio = 1.02,
            .overlap = 0.01,
            .deposit_depth = 6.0,
            .cell_size = 1.0,
            .until_rest = false,
            .tension_share = usual_tension_share,
            .damping_ratio = usual_damping_ratio,
            .overlap_rate = 0.0,
            .points_per_cell = 4.0,
            .filled = true,
            .scaled = false,
            .mach = 0.5,
            .softer = false};
}

std::vector<std::string> codes(const Ending& ending) {
    std::vector<std::string> found;
    for (const fault::Flag& each : flags_of_ending(ending)) {
        const bool warns = each.code == "thin_deposit" || each.code == "overlap_work" ||
                           (each.code == "overlap" && ending.overlap <= 0.05);
        EXPECT_EQ(each.severity, warns ? fault::Severity::warning : fault::Severity::questionable);
        found.push_back(each.code);
    }
    return found;
}

TEST(EndingFlags, AreNoneOfASoundRunAndOneForEachLimitPassed) {
    using Codes = std::vector<std::string>;
    EXPECT_EQ(codes(sound()), Codes{});
    Ending ending = sound();
    ending.moving = "it moves";
    ending.kinetic_share = 0.12;
    EXPECT_EQ(codes(ending), Codes{"still_moving"});
    EXPECT_THAT(flags_of_ending(ending)[0].message,
                HasSubstr("still moving at 12 s with 12 % of the released energy"));
    EXPECT_THAT(flags_of_ending(ending)[0].message, HasSubstr("--set /mpm/duration=until_rest"));
    ending.until_rest = true;
    EXPECT_EQ(flags_of_ending(ending)[0].pointer, "/mpm/longest_duration");
    for (const double share : {-0.21, 0.21, std::nan("")}) {
        ending = sound();
        ending.numerical_share = share;
        EXPECT_EQ(codes(ending), Codes{"numerical_share"}) << share;
    }
    ending = sound();
    ending.stood = true;
    EXPECT_EQ(codes(ending), Codes{});
    ending.numerical_share = -0.5;
    ASSERT_EQ(flags_of_ending(ending).size(), 1u);
    EXPECT_EQ(flags_of_ending(ending)[0].severity, fault::Severity::warning)
        << "no runout hangs on it";
    EXPECT_THAT(flags_of_ending(ending)[0].message,
                HasSubstr("the scheme made 50 % of what so small"));
    ending.numerical_share = std::nan("");
    EXPECT_EQ(flags_of_ending(ending)[0].severity, fault::Severity::questionable);
    for (const double ratio : {0.79, 1.31}) {
        ending = sound();
        ending.volume_ratio = ratio;
        EXPECT_EQ(codes(ending), Codes{"volume_ratio"}) << ratio;
    }
    ending = sound();
    ending.numerical_share = -0.02;
    ending.correction_share = 0.09;
    EXPECT_EQ(codes(ending), Codes{"overlap_work"});
    EXPECT_THAT(flags_of_ending(ending)[0].message,
                HasSubstr("put in 9 % of the released energy (5 % can be trusted), and the rest of "
                          "the scheme took 7 %"));
    ending = sound();
    ending.cell_size = 1.21;
    EXPECT_EQ(codes(ending), Codes{"thin_deposit"});
    EXPECT_THAT(flags_of_ending(ending)[0].message, HasSubstr("6 m deep on the mean, 4.96 cells"));
    ending.deposit_depth = 0.0;
    EXPECT_EQ(codes(ending), Codes{}) << "nothing came past the toe";
    ending = sound();
    for (const double share : {0.011, 0.05, 0.051, std::nan("")}) {
        ending.overlap = share;
        EXPECT_EQ(codes(ending), Codes{"overlap"}) << share;
    }
}

}  // namespace
}  // namespace breach::mpm::test
