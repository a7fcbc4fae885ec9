// Student's factor against published tables, and the number of repeats for a mean.
#include "core/statistics/repeats.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "core/statistics/quantiles.hpp"

namespace breach::statistics::repeats_test {
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
    // One repeat: 1 + 7.0 %; two: 1 + 5.4 %; three: 1 + 4.7 %; twenty: 1 + 3.2 %.
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

/// Nine of ten means of new repeats are within the promised error, however few repeats were
/// measured.
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

/// A setting on three ladders, each with one coarser and one finer rung of half the size. The value
/// depends on the size by a random slope of up to `slope`. Returns whether the mean of new repeats
/// is as near to the limit of all ladders as promised.
bool keeps_promise_over_ladders(double slope, std::size_t draws, std::size_t mean_of,
                                std::mt19937& random) {
    constexpr double scatter = 0.04;
    std::normal_distribution<double> noise(0.0, scatter);
    std::uniform_real_distribution<double> change(-slope, slope);
    const auto measured = [&](double truth) {
        std::vector<double> values(draws);
        for (double& each : values) each = truth + noise(random);
        return repeats_of(values);
    };
    const std::array<double, 3> changes{change(random), change(random), change(random)};
    double truth = 1.0;  // at size 2 of each ladder; at size 0 it is 1
    for (const double each : changes) truth += 2.0 * each;
    const Repeats base = measured(truth);
    std::vector<Share> shares;
    for (const double each : changes) {
        const Repeats fine = measured(truth - each);
        const Convergence found = convergence_of(
            std::array{Rung{4, measured(truth + 2.0 * each)}, Rung{2, base}, Rung{1, fine}});
        shares.push_back({std::abs(fine.mean - base.mean) + *found.error_of_finest * fine.mean,
                          found.course != Course::below_noise});
    }
    double mean = truth;
    for (std::size_t i = 0; i < mean_of; ++i) mean += noise(random) / static_cast<double>(mean_of);
    return std::abs(mean - 1.0) <= promised_error(sum_of(shares), base, 1.0, mean_of);
}

/// Rungs that differ by less than the scatter of one run, and by as much: the worst case for first
/// order from three noisy rungs.
TEST(MeanOfDraws, OverSeveralLaddersKeepsItsPromise) {
    std::mt19937 random(7);
    const struct {
        double slope, least;
    } cases[]{{0.0, 0.98}, {0.01, 0.98}, {0.02, 0.95}, {0.04, 0.87}};
    for (const auto& [slope, least] : cases) {
        for (const std::size_t draws : {3u, 8u}) {
            for (const std::size_t mean_of : {1u, 4u, 20u}) {
                constexpr int times = 4000;
                int kept = 0;
                for (int i = 0; i < times; ++i)
                    kept += keeps_promise_over_ladders(slope, draws, mean_of, random);
                EXPECT_GE(static_cast<double>(kept) / times, least)
                    << slope << " " << draws << " " << mean_of;
            }
        }
    }
}

}  // namespace
}  // namespace breach::statistics::repeats_test
