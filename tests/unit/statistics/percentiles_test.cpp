// Percentiles and exceedance against numpy 1.24.2 and scipy 1.10.1. What they gave, for
// v = [((37 * i) % 64) ** 1.5 / 10 for i in range(64)], n = 64:
//   numpy.percentile(v, p); the ends: numpy.interp(r, range(1, n + 1), sorted(v)) at the r where
//   scipy.special.betainc(r, n + 1 - r, p / 100) is 0.95 and 0.05 (scipy.optimize.brentq)
//   scipy.stats.binomtest(k, n).proportion_ci(0.9, "wilson")
#include "core/statistics/percentiles.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/statistics/quantiles.hpp"

namespace breach::statistics::percentiles_test {
namespace {

std::vector<double> known_values() {
    std::vector<double> values;
    for (int i = 0; i < 64; ++i) values.push_back(std::pow((37 * i) % 64, 1.5) / 10.0);
    return values;
}

TEST(Percentiles, IncompleteBetaIsScipys) {
    EXPECT_NEAR(incomplete_beta(3, 5, 0.3), 0.35293049999999965, 1e-13);
    EXPECT_NEAR(incomplete_beta(60.5, 4.5, 0.95), 0.7009629209530757, 1e-12);
    EXPECT_NEAR(incomplete_beta(0.5, 7, 0.01), 0.2874836298717218, 1e-13);
}

TEST(Percentiles, AreNumpysWithTheEndsThatScipyGives) {
    struct Known {
        double p;
        Interval interval;
    };
    for (const Known& each :
         {Known{5, {0.5616729559300638, 0.014929156269604405, 1.390877763903546}},
          Known{10, {1.5843934672924993, 0.33517561876321944, 3.1826243902334896}},
          Known{50, {17.68100156157434, 12.451839854200047, 23.48514577253377}},
          Known{90, {42.69580821629074, 38.539081612742535, 47.38464683022752}},
          Known{95, {46.30224411817936, 43.28898329486299, 49.827662236140796}}}) {
        const Interval found = percentile(known_values(), each.p);
        EXPECT_NEAR(found.value, each.interval.value, 1e-10) << each.p;
        EXPECT_NEAR(found.low, each.interval.low, 1e-9) << each.p;
        EXPECT_NEAR(found.high, each.interval.high, 1e-9) << each.p;
    }
}

TEST(Percentiles, NeedAsManySamplesAsWilksSays) {
    EXPECT_EQ(samples_needed(50), 5u);
    EXPECT_EQ(samples_needed(90), 29u);
    EXPECT_EQ(samples_needed(10), 29u);
    EXPECT_EQ(samples_needed(95), 59u) << "0.95^59 is the first below 0.05";
    EXPECT_EQ(samples_needed(5), 59u);
    EXPECT_EQ(not_enough(3, 50), "3 samples are not enough for the 50th percentile: 5 are needed");
    EXPECT_EQ(not_enough(1, 93), "1 sample is not enough for the 93rd percentile: 42 are needed");
}

TEST(Percentiles, TheShareBelowALimitHasWilsonsInterval) {
    // (p + z^2 / 2n -+ z sqrt(p (1 - p) / n + z^2 / 4n^2)) / (1 + z^2 / n), z = 1.6448536
    std::vector<double> factors(64, 1.2);
    EXPECT_EQ(share_below(factors, 1.0).value, 0.0);
    EXPECT_NEAR(share_below(factors, 1.0).high, 0.0405594995, 1e-6);
    for (std::size_t i = 0; i < 5; ++i) factors[i] = 0.9;
    factors[5] = 1.0;  // not below 1: stable
    const Interval failed = share_below(factors, 1.0);
    EXPECT_EQ(failed.value, 5.0 / 64.0);
    EXPECT_NEAR(failed.low, 0.0385443904, 1e-6);
    EXPECT_NEAR(failed.high, 0.1519276873, 1e-6);
}

TEST(Percentiles, EqualValuesAreAllowed) {
    std::vector<double> values(64, 0.0);  // runout beyond the toe in 8 samples only
    for (std::size_t i = 0; i < 8; ++i) values[i] = 10.0 + static_cast<double>(i);
    const Interval median = percentile(values, 50);
    EXPECT_EQ(median.value, 0.0);
    EXPECT_EQ(median.low, 0.0);
    EXPECT_EQ(median.high, 0.0);
    EXPECT_GT(percentile(values, 95).value, 10.0);
}

/// Fewest successes for a promise of 90 %; fewer by chance once in a thousand times (3 standard
/// deviations).
double least_kept(double trials) { return 0.9 * trials - 3.0 * std::sqrt(0.09 * trials); }

TEST(Percentiles, NineOfTenIntervalsCoverThePercentile) {
    // Independent lognormal samples, 300 seeds: 90 % within three standard deviations of the
    // binomial.
    constexpr int seeds = 300;
    const std::pair<double, double> known[] = {
        {5, -1.6448536}, {10, -1.2815516}, {50, 0.0}, {90, 1.2815516}, {95, 1.6448536}};
    for (const auto& [p, score] : known) {
        int covered = 0;
        for (int seed = 0; seed < seeds; ++seed) {
            std::mt19937_64 generator(static_cast<std::uint64_t>(seed));
            std::normal_distribution<double> normal;
            std::vector<double> values(64);
            for (double& each : values) each = std::exp(normal(generator));
            const Interval found = percentile(values, p);
            covered += found.low <= std::exp(score) && std::exp(score) <= found.high ? 1 : 0;
        }
        EXPECT_GE(covered, least_kept(seeds)) << p;
        EXPECT_LE(covered, 2 * 0.9 * seeds - least_kept(seeds)) << p;
    }
}

TEST(Exceedance, IsTheShareAboveEachValueWithWilsonsBand) {
    std::vector<double> values{3, 1, 2, 2, 4, 5, 6, 7, 8, 9};
    const std::vector<Exceedance> curve = exceedance(values);
    ASSERT_EQ(curve.size(), 9u) << "each distinct value once";
    EXPECT_DOUBLE_EQ(curve[1].value, 2.0);
    EXPECT_DOUBLE_EQ(curve[1].probability.value, 0.7);
    EXPECT_NEAR(curve[1].probability.low, 1.0 - 0.5583002041301649, 1e-12);
    EXPECT_NEAR(curve[1].probability.high, 1.0 - 0.1268765839031979, 1e-12);
    EXPECT_DOUBLE_EQ(curve.back().probability.value, 0.0);
    EXPECT_NEAR(curve.back().probability.high, 0.21294197008340698, 1e-12);
}

TEST(Exceedance, OfManyValuesIsShownAtASpreadOfThem) {
    std::vector<double> values;
    for (int i = 0; i < 1000; ++i) values.push_back(i);
    const std::vector<Exceedance> curve = exceedance(values);
    ASSERT_EQ(curve.size(), most_points);
    EXPECT_DOUBLE_EQ(curve.front().value, 0.0);
    EXPECT_DOUBLE_EQ(curve.back().value, 999.0);
    EXPECT_DOUBLE_EQ(curve[50].probability.value, 0.5);
}

}  // namespace
}  // namespace breach::statistics::percentiles_test
