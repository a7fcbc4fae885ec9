#include "transfer_tool/advice.hpp"

#include <gtest/gtest.h>

#include "core/fault/fault.hpp"

namespace breach::transfer {
namespace {

scene::Scene scene_with(const scene::AdviceWindow& window) {
    scene::Scene scene{};
    scene.transfer = scene::Transfer{};
    scene.transfer->window = window;
    return scene;
}

scene::Scene case_scene() {
    return scene_with({"liquefaction_depth > 18.5 and failure_surfaces >= 2",
                       "jacobian_least_avg < 0.97 or epsilon_q_avg > 0.2", 0.0, "midpoint"});
}

/// The course in docs/reference/methods/mochikoshi_case.md: depth 18.5 m at 14.75 s, 20 % at 17.5
/// s.
std::vector<telemetry::Line> course(double until) {
    std::vector<telemetry::Line> lines;
    for (int i = 0; 0.05 * i <= until + 1e-9; ++i) {
        const double t = 0.05 * i;
        lines.push_back({t,
                         i,
                         {{"time", t},
                          {"liquefaction_depth", t < 8.0 ? 0.0 : 18.52 * (t - 8.0) / 6.75},
                          {"failure_surfaces", (t >= 13.0) + (t >= 14.75)},
                          {"kinetic_energy", t < 14.75 ? 1e3 : 1e3 * std::exp(2.0 * (t - 14.75))},
                          {"jacobian_least_avg", 1.0 - 0.03 * t / 20.25},
                          {"epsilon_q_avg", 0.2 * t / 17.5}}});
    }
    return lines;
}

TEST(Advice, FindsTheWindowAndTheSnapshotHalfWay) {
    const Advice advice = advise(case_scene(), course(22.0), {10.0, 15.0, 16.0, 16.5, 18.0});
    ASSERT_TRUE(advice.lower && advice.upper && advice.half_way && advice.pick);
    EXPECT_NEAR(advice.lower->time, 14.75, 1e-9);
    EXPECT_NEAR(advice.upper->time, 17.55, 1e-9) << "strain, before the Jacobian at 20.25 s";
    EXPECT_NEAR(*advice.half_way, 16.15, 1e-9);
    EXPECT_EQ(advice.snapshots, (std::vector<double>{15.0, 16.0, 16.5}));
    EXPECT_EQ(*advice.pick, 16.0);
    EXPECT_NEAR(advice.lower->values.at("liquefaction_depth"), 18.52, 1e-9);
    const std::string text = as_text(advice);
    for (const char* part : {"lower edge 14.75 s", "half-way 16.15 s", "take the one at 16 s"})
        EXPECT_NE(text.find(part), std::string::npos) << text;
}

TEST(Advice, AFemThatEndsFirstClosesTheWindow) {
    const Advice advice = advise(case_scene(), course(16.0), {});
    ASSERT_TRUE(advice.lower);
    EXPECT_FALSE(advice.upper);
    EXPECT_FALSE(advice.pick);
    EXPECT_NEAR(*advice.half_way, 0.5 * (14.75 + 16.0), 1e-9);
}

TEST(Advice, SaysWhenTheFailureHasNotDevelopedAndWhichSignsAreThere) {
    const Advice advice = advise(case_scene(), course(14.0), {13.0});
    EXPECT_FALSE(advice.lower || advice.pick || advice.half_way);
    EXPECT_NE(as_text(advice).find("has not developed"), std::string::npos);
    const auto onset = [&](const std::string& name) {
        for (const Sign& each : advice.signs)
            if (each.name == name) return each.onsets;
        return std::vector<double>{-1.0};
    };
    EXPECT_EQ(onset("first failure surface").size(), 1u);
    EXPECT_NEAR(onset("first failure surface").front(), 13.0, 1e-9);
    EXPECT_TRUE(onset("second failure surface").empty());
}

TEST(Advice, SaysThatThereIsNoWindowWhereTheMeshWasTooDistortedBefore) {
    auto scene = case_scene();
    scene.transfer->window->upper = "epsilon_q_avg > 0.1";  // from 8.75 s on
    const Advice advice = advise(scene, course(22.0), {10.0, 14.75, 16.0});
    ASSERT_TRUE(advice.lower && advice.shut_since);
    EXPECT_NEAR(advice.lower->time, 14.75, 1e-9);
    EXPECT_NEAR(*advice.shut_since, 8.8, 1e-9);
    EXPECT_FALSE(advice.upper || advice.pick || advice.half_way);
    const std::string text = as_text(advice);
    for (const char* part : {"no window", "at 14.75 s", "too distorted since 8.8 s"})
        EXPECT_NE(text.find(part), std::string::npos) << text;
}

TEST(Advice, AFieldThatTheTelemetryLacksIsNamed) {
    auto lines = course(20.0);
    for (auto& line : lines) line.values.erase("failure_surfaces");
    const Advice advice = advise(case_scene(), lines, {});
    EXPECT_EQ(advice.missing, std::vector<std::string>{"failure_surfaces"});
    EXPECT_FALSE(advice.lower);
}

TEST(Advice, BothConditionsAreRefusedAtOnceByTheirPointers) {
    try {
        window_of(scene_with({"depth >", "1 + 1", 0.0, "first"}));
        FAIL();
    } catch (const fault::BadInput& refusal) {
        ASSERT_EQ(refusal.faults().size(), 2u);
        EXPECT_EQ(refusal.faults()[0].pointer, "/transfer/window/lower");
        EXPECT_EQ(refusal.faults()[1].pointer, "/transfer/window/upper");
    }
}

}  // namespace
}  // namespace breach::transfer
