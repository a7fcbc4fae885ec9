// Student's factor against published tables, and how many draws a mean needs.
#include "services/orchestrator/accuracy/mean_of_draws.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace breach::orchestrator {
namespace {

TEST(StudentFactor, IsThatOfTheTables) {
    // Abramowitz and Stegun 1964, table 26.10: A = 0.90 and 0.95.
    const struct {
        std::size_t freedom;
        double of_90;
        double of_95;
    } table[]{{1, 6.314, 12.706}, {2, 2.920, 4.303}, {3, 2.353, 3.182},  {4, 2.132, 2.776},
              {5, 2.015, 2.571},  {9, 1.833, 2.262}, {10, 1.812, 2.228}, {19, 1.729, 2.093}};
    for (const auto& [freedom, of_90, of_95] : table) {
        EXPECT_NEAR(student_factor(0.90, freedom), of_90, 5e-4) << freedom;
        EXPECT_NEAR(student_factor(0.95, freedom), of_95, 5e-4) << freedom;
    }
    EXPECT_NEAR(student_factor(0.90, 100000), 1.6449, 1e-4) << "the normal distribution's";
}

TEST(MeanOfDraws, NeedsFewerDrawsTheLessItIsOff) {
    const Repeats measured{.mean = 10.0, .deviation = 0.3, .count = 5};
    const double t = 2.132;  // four degrees of freedom
    EXPECT_NEAR(promised_error(0.01, measured, 10.0, 4),
                0.01 + t * 0.03 * std::sqrt(1.0 / 4 + 1.0 / 5), 1e-5);
    // One draw: 1 + 7.0 %; two: 1 + 5.4 %; three: 1 + 4.7 %; twenty: 1 + 3.2 %.
    EXPECT_EQ(draws_within(0.081, 0.01, measured, 10.0), 1u);
    EXPECT_EQ(draws_within(0.065, 0.01, measured, 10.0), 2u);
    EXPECT_EQ(draws_within(0.060, 0.01, measured, 10.0), 3u);
    EXPECT_FALSE(draws_within(0.038, 0.01, measured, 10.0)) << "the bias is known no better";
    EXPECT_FALSE(draws_within(0.009, 0.01, measured, 10.0)) << "averaging leaves the bias";
}

TEST(MeanOfDraws, OfOneMeasuredDrawIsWorthItsBias) {
    const Repeats once{.mean = 10.0, .deviation = std::nullopt, .count = 1};
    EXPECT_DOUBLE_EQ(promised_error(0.02, once, 10.0, 7), 0.02);
    EXPECT_EQ(draws_within(0.02, 0.02, once, 10.0), 1u);
}

/// What the promise says: nine of ten means of new draws keep it, however few draws were measured.
TEST(MeanOfDraws, KeepsItsPromiseInNineOfTenTimes) {
    std::mt19937 random(5);
    std::normal_distribution<double> value(10.0, 0.4);
    for (const std::size_t measured : {2u, 3u, 5u}) {
        constexpr std::size_t mean_of = 4;
        constexpr int times = 20000;
        int kept = 0;
        for (int i = 0; i < times; ++i) {
            std::vector<double> values(measured);
            for (double& each : values) each = value(random);
            const Repeats repeats = repeats_of(values);
            double mean = 0.0;
            for (std::size_t k = 0; k < mean_of; ++k) mean += value(random) / mean_of;
            // The reference is the setting's own mean: no bias.
            const double off = std::abs(mean - repeats.mean) / repeats.mean;
            if (off <= promised_error(0.0, repeats, repeats.mean, mean_of)) ++kept;
        }
        EXPECT_NEAR(static_cast<double>(kept) / times, confidence, 0.01) << measured;
    }
}

}  // namespace
}  // namespace breach::orchestrator
