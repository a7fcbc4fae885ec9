// Motions in a wrong unit are refused or flagged, with the likely unit.
#include "core/motion/plausibility.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace breach::motion {
namespace {

/// Ten seconds of 2 Hz, at rest at both ends.
Recording shaking(double peak, Quantity quantity = Quantity::acceleration, double dt = 0.01) {
    Recording motion{quantity, {dt, {}}, "test"};
    for (int i = 0; i <= 1000; ++i) {
        const double t = 0.01 * i, envelope = std::sin(0.1 * std::numbers::pi * t);
        motion.series.values.push_back(peak * envelope *
                                       std::cos(4.0 * std::numbers::pi * (t - 5.0)));
    }
    return motion;
}

std::string refusal(const Recording& motion) {
    const Remarks remarks = remarks_about(motion, "/here");
    EXPECT_EQ(remarks.faults.size(), 1U);
    if (remarks.faults.empty()) return "";
    EXPECT_EQ(remarks.faults[0].pointer, "/here");
    return remarks.faults[0].cause + ": " + remarks.faults[0].remedy;
}

std::string warning(const Recording& motion) {
    const Remarks remarks = remarks_about(motion, "/here");
    EXPECT_TRUE(remarks.faults.empty());
    EXPECT_EQ(remarks.flags.size(), 1U);
    return remarks.flags.empty() ? "" : remarks.flags[0].code + ": " + remarks.flags[0].message;
}

void expect_says(const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
}

TEST(MotionPlausibility, AnOrdinaryMotionPassesWithoutAWord) {
    for (const double g : {0.05, 0.3, 1.0}) {
        const Remarks remarks = remarks_about(shaking(g * standard_gravity), "/here");
        EXPECT_TRUE(remarks.faults.empty());
        for (const auto& flag : remarks.flags) ADD_FAILURE() << flag.message;
    }
    EXPECT_TRUE(remarks_about(shaking(0.3, Quantity::velocity), "/here").flags.empty());
}

TEST(MotionPlausibility, AFaultIsAFlagForThoseWhoOnlyReadTheMotion) {
    const auto impossible = warnings_about(shaking(196.2 * standard_gravity), "/here");
    ASSERT_EQ(impossible.size(), 1U);
    EXPECT_EQ(impossible[0].code, "impossible");
    EXPECT_EQ(impossible[0].severity, fault::Severity::questionable);
    expect_says(impossible[0].message, "the motion has a PGA of 196.2 g, which no earthquake has");
    const auto strong = shaking(1.962 * standard_gravity);
    ASSERT_EQ(warnings_about(strong, "/here").size(), 1U);
    EXPECT_EQ(warnings_about(strong, "/here")[0].message,
              remarks_about(strong, "/here").flags[0].message);
    EXPECT_TRUE(warnings_about(shaking(0.3 * standard_gravity), "/here").empty());
    EXPECT_TRUE(warnings_about(shaking(500.0, Quantity::displacement), "/here").empty());
    const Recording constant{Quantity::acceleration, {0.01, std::vector<double>(1000, 1.0)}, ""};
    ASSERT_EQ(warnings_about(constant, "/here").size(), 1U);
    expect_says(warnings_about(constant, "/here")[0].message, "one constant value, 1, in 1000");
}

TEST(MotionPlausibility, MetresPerSecondSquaredGivenAsGAreNamed) {
    expect_says(warning(shaking(1.962 * standard_gravity)),
                "a PGA of 1.962 g, hardly plausible: 1.962 looks like m/s2 given as g: divide by "
                "9.81 (0.2001 g)");
    expect_says(refusal(shaking(4.905 * standard_gravity)), "divide by 9.81 (0.5002 g)");
    expect_says(refusal(shaking(196.2 * standard_gravity)), "cm/s2 (gal) given as g");
}

TEST(MotionPlausibility, GGivenAsMetresPerSecondSquaredIsNamed) {
    expect_says(warning(shaking(0.03)), "g given as m/s2");
}

TEST(MotionPlausibility, VelocitiesInCentimetresAreNamed) {
    expect_says(refusal(shaking(30.0, Quantity::velocity)), "cm/s given as m/s: divide by 100");
    expect_says(warning(shaking(5.0, Quantity::velocity)), "cm/s given as m/s");
    expect_says(warning(shaking(0.001, Quantity::velocity)), "m/s given as cm/s");
}

TEST(MotionPlausibility, TimesInMillisecondsAreNamed) {
    const std::string text = refusal(shaking(3.0, Quantity::acceleration, 10.0));
    expect_says(text, "a time step of 10 s");
    expect_says(text, "10 looks like milliseconds: divide the times by 1000 (0.01 s)");
}

TEST(MotionPlausibility, AMotionOfZerosIsFlagged) {
    expect_says(warning(shaking(0.0)), "zero throughout");
}

TEST(MotionPlausibility, AVelocityLeftAtTheEndIsFlagged) {
    Recording motion = shaking(3.0);
    for (double& a : motion.series.values) a += 0.1;
    expect_says(warning(motion), "drifting_motion: the motion leaves 0.988 m/s at its end");
}

TEST(MotionPlausibility, StepsThatPassOverSamplesAreFlagged) {
    const Series series = shaking(3.0).series;
    EXPECT_FALSE(warning_about_step(series, 0.02, "/step"));
    const auto flag = warning_about_step(series, 5.0, "/step");
    ASSERT_TRUE(flag);
    EXPECT_EQ(flag->code, "coarse_step");
    EXPECT_EQ(flag->pointer, "/step");
    expect_says(flag->message, "pass over 500 samples");
    EXPECT_FALSE(warning_about_step({0.001, {0.0, 1.0}}, 0.01, "/step")) << "resolves 10 Hz";
}

TEST(MotionPlausibility, SaysHowStrongTheMotionIs) {
    const std::string text = summary_of(shaking(0.3 * standard_gravity));
    expect_says(text, "PGA 0.3 g");
    expect_says(text, "10 s in steps of 0.01 s");
}

}  // namespace
}  // namespace breach::motion
