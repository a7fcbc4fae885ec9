// Sampling: distributions, hypercubes, Sobol points, rank correlations.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "core/statistics/distribution.hpp"
#include "core/statistics/points.hpp"
#include "core/statistics/quantiles.hpp"
#include "core/statistics/rank_correlation.hpp"

namespace breach::statistics::sampling_test {
namespace {

// Reference values: Debian's python3-scipy 1.10.1 (scipy.stats.norm, lognorm, truncnorm, triang:
// ppf; scipy.stats.qmc.Sobol(64, scramble=False, bits=32).random(1024)).

TEST(Distribution, QuantilesAreThoseOfScipy) {
    const auto near = [](double value, double wanted) {
        EXPECT_NEAR(value, wanted, 1e-13 * (1.0 + std::abs(wanted)));
    };
    near(normal_quantile(1e-12), -7.034483825301131);
    near(normal_quantile(1e-6), -4.753424308822899);
    near(normal_quantile(0.02425), -1.972961051311885);
    near(normal_quantile(0.3), -0.5244005127080409);
    near(normal_quantile(0.5), 0.0);
    near(normal_quantile(0.9), 1.2815515655446004);
    const Distribution lognormal{DistributionKind::lognormal, {1.0, 0.3}, {}};
    near(quantile(lognormal, 0.05), 0.6170138213289258);
    near(quantile(lognormal, 0.9), 1.4567570456109986);
    const Distribution triangular{DistributionKind::triangular, {1.0, 2.0, 5.0}, {}};
    near(quantile(triangular, 0.05), 1.4472135954999579);
    near(quantile(triangular, 0.25), 2.0);
    near(quantile(triangular, 0.9), 3.904554884989668);
    const Distribution logs{DistributionKind::log_uniform, {100.0, 3000.0}, {}};
    near(quantile(logs, 0.5), std::sqrt(100.0 * 3000.0));
    near(quantile({DistributionKind::uniform, {-1.0, 3.0}, {}}, 0.25), 0.0);
}

TEST(Distribution, BetweenTakesTheQuantilesThatLieThere) {
    const Distribution cut{DistributionKind::lognormal, {1.0, 0.3}, {{0.4, 2.5}}};
    EXPECT_NEAR(quantile(cut, 0.05), 0.6184293137021929, 1e-13);
    EXPECT_NEAR(quantile(cut, 0.9), 1.4550077116616316, 1e-13);
    EXPECT_GT(quantile(cut, 1e-12), 0.4);  // no probability at the bound
    // Far in the tail, where the probabilities below are 1 to round-off.
    const Distribution tail{DistributionKind::normal, {0.0, 1.0}, {{6.0, 8.0}}};
    EXPECT_NEAR(quantile(tail, 0.1), 6.017085051314984, 1e-12);
    EXPECT_NEAR(quantile(tail, 0.9), 6.363413413274562, 1e-12);
}

TEST(Distribution, ShareBelowIsTheQuantilesInverse) {
    for (const Distribution& each : {Distribution{DistributionKind::uniform, {2, 5}, {}},
                                     Distribution{DistributionKind::log_uniform, {2, 5}, {}},
                                     Distribution{DistributionKind::normal, {2, 5}, {}},
                                     Distribution{DistributionKind::lognormal, {2, 0.5}, {}},
                                     Distribution{DistributionKind::triangular, {2, 2, 5}, {}},
                                     Distribution{DistributionKind::triangular, {2, 5, 5}, {}}})
        for (const double u : {0.001, 0.2, 0.5, 0.77, 0.999})
            EXPECT_NEAR(share_below(each, quantile(each, u)), u, 1e-13)
                << words::name_of(each.kind);
}

TEST(Sobol, IsThatOfJoeAndKuoInAllDimensions) {
    const auto points = sobol_sequence(1024, most_sobol_dimensions);
    const auto share = [&](std::size_t i, std::size_t d) { return points[i][d] * 0x1p-32; };
    const std::vector<double> of_777{0.6923828125, 0.9365234375, 0.3232421875,
                                     0.8994140625, 0.1376953125, 0.4267578125};
    const std::vector<std::size_t> dimensions{0, 1, 9, 31, 62, 63};
    for (std::size_t k = 0; k < dimensions.size(); ++k)
        EXPECT_EQ(share(777, dimensions[k]), of_777[k]);
    // Hash of all 1024 x 64 numbers in order: h = (h * 1099511628211) xor x, modulo 2^64.
    std::uint64_t hash = 0;
    for (const auto& point : points)
        for (const std::uint32_t x : point) hash = (hash * 1099511628211ULL) ^ x;
    EXPECT_EQ(hash, 7683096977386504192ULL);
}

TEST(Sobol, ShiftedByASeedIsStillANet) {
    const Points a = sobol_points(64, 3, 7), b = sobol_points(64, 3, 8),
                 more = sobol_points(96, 3, 7);
    EXPECT_NE(a, b);
    EXPECT_EQ(a, Points(more.begin(), more.begin() + 64));
    for (std::size_t d = 0; d < 3; ++d) {
        std::set<int> slices;
        for (const auto& each : a) slices.insert(static_cast<int>(each[d] * 64));
        EXPECT_EQ(slices.size(), 64u);  // one point in each
    }
}

/// Whether each of `slices` equal slices of every dimension contains one of the first points.
void expect_hypercube(const Points& points, std::size_t slices) {
    for (std::size_t d = 0; d < points.front().size(); ++d) {
        std::set<std::size_t> taken;
        for (std::size_t i = 0; i < slices; ++i)
            taken.insert(static_cast<std::size_t>(points[i][d] * static_cast<double>(slices)));
        EXPECT_EQ(taken.size(), slices) << "dimension " << d;
        EXPECT_LT(*taken.rbegin(), slices);
    }
}

TEST(LatinHypercube, HasOnePointPerSliceAtEveryDoublingAndKeepsTheFirst) {
    const Points points = latin_hypercube(200, 25, 4, 3);
    for (const std::size_t slices : {25u, 50u, 100u, 200u}) expect_hypercube(points, slices);
    for (const std::size_t fewer : {25u, 60u, 100u}) {
        const Points part = latin_hypercube(fewer, 25, 4, 3);
        EXPECT_EQ(part,
                  Points(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(fewer)));
    }
    EXPECT_NE(latin_hypercube(25, 25, 4, 4), latin_hypercube(25, 25, 4, 3));
}

TEST(RankCorrelation, IsSpearmans) {
    // scipy.stats.spearmanr([1, 2, 3, 4, 5, 5], [5, 6, 7, 8, 7, 1]).statistic
    const std::vector<double> a{1, 2, 3, 4, 5, 5}, b{5, 6, 7, 8, 7, 1};
    EXPECT_NEAR(rank_correlation(a, b), 0.1323529411764706, 1e-14);
    EXPECT_EQ(rank_correlation(a, std::vector<double>(6, 2.0)), 0.0);
}

TEST(Points, AreTheSameOnEveryMachine) {
    // Fixed: with other numbers the same seed would give another study.
    const Points cube = latin_hypercube(4, 4, 1, 7);
    const std::vector<double> drawn{0.55055943378086536, 0.91635354718279849, 0.36814719443571819,
                                    0.0015524645651292523};
    for (std::size_t i = 0; i < drawn.size(); ++i) EXPECT_EQ(cube[i][0], drawn[i]);
    EXPECT_EQ(sobol_points(1, 2, 7)[0],
              (std::vector<double>{0.85091535456012934, 0.30026940803509206}));
}

}  // namespace
}  // namespace breach::statistics::sampling_test
