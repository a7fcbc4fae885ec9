// The inverse search on functions with known solutions.
#include "core/statistics/inverse.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

namespace breach::statistics::inverse_test {
namespace {

const InverseQuestion question{.target = 215.0,
                               .quantity = "runout_beyond_toe",
                               .unit = "m",
                               .low = 0.4,
                               .high = 2.5,
                               .logarithmic = true};

struct Search {
    InverseAdvice advice;
    std::vector<InverseStep> steps;
};

/// Runs the advised values until there are no more.
Search search(const InverseQuestion& asked, const std::function<double(double)>& run,
              std::size_t lattices) {
    Search found;
    for (int round = 0; round < 60; ++round) {
        found.advice = advise_inverse(asked, found.steps);
        if (found.advice.run_next.empty()) return found;
        for (const double value : found.advice.run_next) {
            found.steps.push_back({.value = value, .results = {}});
            for (std::size_t i = 0; i < lattices; ++i)
                found.steps.back().results.push_back(run(value));
        }
    }
    ADD_FAILURE() << "the search does not end";
    return found;
}

TEST(Inverse, FindsTheFactorWithinItsTolerance) {
    const Search found = search(
        question, [](double v) { return 150.0 / v; }, 1);
    ASSERT_TRUE(found.advice.found) << found.advice.refused;
    EXPECT_NEAR(found.advice.found->value, 150.0 / 215.0, 0.02 * 150.0 / 215.0);
    EXPECT_FALSE(found.advice.has_interval) << "one lattice knows no scatter";
    // ln(2.5 / 0.4) / 0.02 = 92 < 2^7
    EXPECT_EQ(found.steps.size(), 2u + 7u);
}

TEST(Inverse, RefusesATargetThatTheEndsDoNotEnclose) {
    const Search found = search(
        question, [](double v) { return 20.0 / v; }, 2);
    EXPECT_EQ(found.steps.size(), 2u) << "the ends only";
    EXPECT_FALSE(found.advice.found);
    EXPECT_EQ(found.advice.refused,
              "runout_beyond_toe is 50 m at 0.4 and 8 m at 2.5: 215 m is not between them");
}

TEST(Inverse, WaitsForWhatRunsAndRefusesWhatFailed) {
    const std::vector<InverseStep> open{{.value = 0.4, .results = {300}},
                                        {.value = 2.5, .results = {}, .open = true}};
    EXPECT_TRUE(advise_inverse(question, open).run_next.empty());
    EXPECT_EQ(advise_inverse(question, open).refused, "");
    const std::vector<InverseStep> failed{{.value = 0.4, .results = {300}},
                                          {.value = 2.5, .results = {}}};
    EXPECT_EQ(advise_inverse(question, failed).refused, "no run at 2.5 gave a result");
}

TEST(Inverse, NineOfTenIntervalsCoverTheTrueValue) {
    constexpr int seeds = 200;
    int covered = 0;
    std::size_t steps = 0;
    for (int seed = 0; seed < seeds; ++seed) {
        std::mt19937_64 generator(static_cast<std::uint64_t>(seed));
        std::normal_distribution<double> noise(0.0, 25.0);
        const Search found = search(
            question, [&](double v) { return 150.0 / v + noise(generator); }, 3);
        ASSERT_TRUE(found.advice.found && found.advice.has_interval);
        const Interval& each = *found.advice.found;
        EXPECT_LE(each.low, each.value);
        EXPECT_GE(each.high, each.value);
        covered += each.low <= 150.0 / 215.0 && 150.0 / 215.0 <= each.high ? 1 : 0;
        steps += found.steps.size();
    }
    // 90 % minus three standard deviations of the binomial.
    EXPECT_GE(covered, 0.9 * seeds - 3.0 * std::sqrt(0.09 * seeds));
    EXPECT_LT(steps, 8u * seeds) << "what noise hides is not halved on";
}

TEST(Inverse, WithoutATransferTheResultIsZeroAndNotPartOfTheNoise) {
    const std::vector<InverseStep> steps{{.value = 0.4, .results = {300, 302}},
                                         {.value = 0.69, .results = {216, 220}},
                                         {.value = 0.695, .results = {0, 0}, .stood = 2},
                                         {.value = 2.5, .results = {0, 0}, .stood = 2}};
    const InverseAdvice advice = advise_inverse(question, steps);
    ASSERT_TRUE(advice.found) << advice.refused;
    EXPECT_GT(advice.found->value, 0.69);
    EXPECT_LT(advice.found->value, 0.695);
    EXPECT_NEAR(*advice.noise, std::sqrt((2.0 + 8.0) / 2.0), 1e-12) << "of the first two alone";
    EXPECT_EQ(advice.remark,
              "at 0.695 nothing was transferred, for no trigger's condition was met: the result is "
              "taken as 0 there; from 0.69 to 0.695 it goes from 218 m to 0 m at once: no run gave "
              "the target itself");
}

/// 0 up to 0.9, then increasing, as the runout of a dam that stands first.
double rises_from(double v) { return std::max(0.0, 100.0 * (v - 0.9)); }
/// The mirrored function.
double falls_to(double v) { return std::max(0.0, 100.0 * (1.6 - v)); }

TEST(Inverse, OfATargetThatManyValuesGiveFindsWhereTheResultLeavesIt) {
    InverseQuestion none = question;
    none.target = 0.0;
    none.low = 0.5;
    none.high = 2.0;
    for (const bool logarithmic : {true, false}) {
        none.logarithmic = logarithmic;
        for (const std::size_t lattices : {1u, 3u}) {
            const Search rising = search(none, rises_from, lattices);
            ASSERT_TRUE(rising.advice.found) << rising.advice.refused;
            EXPECT_NEAR(rising.advice.found->value, 0.9, 0.03);
            EXPECT_EQ(rising.advice.remark.find("no run gave"), std::string::npos);
            const Search falling = search(none, falls_to, lattices);
            ASSERT_TRUE(falling.advice.found) << falling.advice.refused;
            EXPECT_NEAR(falling.advice.found->value, 1.6, 0.03);
            EXPECT_EQ(falling.advice.remark.find("no run gave"), std::string::npos);
        }
    }
}

TEST(Inverse, TheIntervalOfSuchATargetEndsWithTheStretchThatGivesIt) {
    InverseQuestion none = question;
    none.target = 0.0;
    const std::vector<InverseStep> steps{{.value = 0.4, .results = {0, 0}},
                                         {.value = 0.8, .results = {0, 0}},
                                         {.value = 0.9, .results = {0, 0}},
                                         {.value = 0.905, .results = {3, 5}},
                                         {.value = 2.5, .results = {160, 162}}};
    const InverseAdvice advice = advise_inverse(none, steps);
    ASSERT_TRUE(advice.found && advice.has_interval) << advice.refused;
    EXPECT_NEAR(advice.found->value, 0.9, 1e-12);
    EXPECT_NEAR(advice.found->low, 0.9, 1e-12);
    EXPECT_GT(advice.found->high, 0.9);
    EXPECT_LT(advice.found->high, 0.91);
    EXPECT_EQ(advice.remark, "");
}

TEST(Inverse, RefusesATargetThatBothEndsGive) {
    InverseQuestion none = question;
    none.target = 0.0;
    const Search found = search(
        none, [](double) { return 0.0; }, 2);
    EXPECT_FALSE(found.advice.found);
    EXPECT_EQ(
        found.advice.refused,
        "runout_beyond_toe is 0 m at 0.4 and at 2.5: values between them give the same result");
}

TEST(Inverse, LowerBoundsBesideTheTargetMakeItABoundAsWell) {
    // Decreases with the value: a longer run would reach the target at a larger one.
    std::vector<InverseStep> steps{{.value = 0.4, .results = {300, 302}},
                                   {.value = 0.69, .results = {216, 217}, .moving = 1},
                                   {.value = 0.7, .results = {213, 214}},
                                   {.value = 2.5, .results = {10, 12}}};
    const InverseAdvice falling = advise_inverse(question, steps);
    ASSERT_TRUE(falling.found);
    EXPECT_EQ(falling.bound, Bound::at_least);
    EXPECT_EQ(falling.remark,
              "1 of the 4 results beside it are lower bounds, for their soil still moved: it is at "
              "least this value");
    steps[0].moving = 2;
    steps[1].moving = 0;
    EXPECT_EQ(advise_inverse(question, steps).bound, Bound::none) << "far from the target";
    for (InverseStep& each : steps) each.value = 1.0 / each.value;
    steps[2].moving = 1;
    EXPECT_EQ(advise_inverse(question, steps).bound, Bound::at_most) << "it rises with the value";
}

TEST(Inverse, ALowerBoundThatMissesTheTargetIsReportedAsOne) {
    const std::vector<InverseStep> steps{{.value = 0.4, .results = {200}, .moving = 1},
                                         {.value = 2.5, .results = {10}}};
    EXPECT_EQ(advise_inverse(question, steps).refused,
              "runout_beyond_toe is at least 200 m at 0.4 and 10 m at 2.5: 215 m is not between "
              "them");
}

TEST(Inverse, OfAValueThatIsNoFactorHalvesTheRangeItself) {
    InverseQuestion angle = question;
    angle.target = 10.0;
    angle.low = 5.0;
    angle.high = 25.0;
    angle.logarithmic = false;
    const Search found = search(
        angle, [](double v) { return 30.0 - v; }, 1);
    EXPECT_NEAR(found.advice.found->value, 20.0, 0.4);
    EXPECT_DOUBLE_EQ(found.steps[2].value, 15.0);
}

}  // namespace
}  // namespace breach::statistics::inverse_test
