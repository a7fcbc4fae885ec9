// What a sample is drawn from: distributions, hypercubes, Sobol points, rank correlations.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "services/orchestrator/sampling/points.hpp"
#include "services/orchestrator/sampling/rank_correlation.hpp"
#include "services/orchestrator/sampling/samples.hpp"

namespace breach::orchestrator::sampling_test {
namespace {

// The numbers of scipy below were printed by Debian's python3-scipy 1.10.1 (scipy.stats.norm, lognorm,
// truncnorm, triang: ppf; scipy.stats.qmc.Sobol(64, scramble=False, bits=32).random(1024)).

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
    EXPECT_GT(quantile(cut, 1e-12), 0.4);  // no value piles up at the bound
    // Far out, where the shares below are 1 to round-off.
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
            EXPECT_NEAR(share_below(each, quantile(each, u)), u, 1e-13) << name_of(each.kind);
}

TEST(Sobol, IsThatOfJoeAndKuoInAllDimensions) {
    const auto points = sobol_sequence(1024, most_sobol_dimensions);
    const auto share = [&](std::size_t i, std::size_t d) { return points[i][d] * 0x1p-32; };
    const std::vector<double> of_777{0.6923828125, 0.9365234375, 0.3232421875,
                                     0.8994140625, 0.1376953125, 0.4267578125};
    const std::vector<std::size_t> dimensions{0, 1, 9, 31, 62, 63};
    for (std::size_t k = 0; k < dimensions.size(); ++k)
        EXPECT_EQ(share(777, dimensions[k]), of_777[k]);
    // Every number of the 1024 x 64, folded in order: h = (h * 1099511628211) xor x, modulo 2^64.
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

/// Whether each of `slices` equal slices of every dimension holds one of the first points.
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

UncertaintyPlan plan_of(std::size_t samples, double rank, Sampling sampling) {
    UncertaintyPlan plan;
    plan.samples = plan.drawn = plan.first = samples;
    plan.seed = 11;
    plan.sampling = sampling;
    for (const char* name : {"strength", "viscosity", "friction", "density"})
        plan.parameters.push_back({.name = name,
                                   .kind = ParameterKind::value,
                                   .entries = {},
                                   .distribution = {DistributionKind::lognormal, {1.0, 0.5}, {}},
                                   .choices = {}});
    plan.correlations = {{0, 1, rank}, {1, 2, -0.4}};
    return plan;
}

std::vector<double> column(const std::vector<DrawnSample>& samples, std::size_t parameter) {
    std::vector<double> values;
    for (const DrawnSample& each : samples) values.push_back(each.draws[parameter]);
    return values;
}

double worst_miss(const UncertaintyPlan& plan, std::size_t count) {
    const auto samples = samples_of(plan, count);
    const Matrix wanted = correlation_matrix(plan);
    double worst = 0.0;
    for (std::size_t a = 0; a < 4; ++a)
        for (std::size_t b = 0; b < a; ++b)
            worst = std::max(
                worst,
                std::abs(rank_correlation(column(samples, a), column(samples, b)) - wanted[a][b]));
    return worst;
}

TEST(Samples, ReachTheAskedRankCorrelation) {
    for (const double rank : {-0.6, 0.3, 0.8}) {
        EXPECT_LT(worst_miss(plan_of(16, rank, Sampling::latin_hypercube), 16), 0.02) << rank;
        EXPECT_LT(worst_miss(plan_of(64, rank, Sampling::latin_hypercube), 64), 0.01) << rank;
        EXPECT_LT(worst_miss(plan_of(64, rank, Sampling::latin_hypercube), 128), 0.01) << rank;
        EXPECT_LT(worst_miss(plan_of(256, rank, Sampling::sobol), 256), 0.03) << rank;
    }
}

TEST(Samples, KeepTheFirstWhenMoreAreDrawn) {
    for (const Sampling each : {Sampling::latin_hypercube, Sampling::sobol}) {
        const UncertaintyPlan plan = plan_of(64, 0.3, each);
        const auto few = samples_of(plan, 64), many = samples_of(plan, 128);
        ASSERT_EQ(many.size(), 128u);
        for (std::size_t i = 0; i < few.size(); ++i) EXPECT_EQ(few[i].draws, many[i].draws);
    }
}

TEST(Samples, DrawOptionsByTheirWeightsAndLatticesAlike) {
    UncertaintyPlan plan;
    plan.samples = plan.drawn = plan.first = 60;
    plan.parameters = {{.name = "motion",
                        .kind = ParameterKind::choice,
                        .entries = {},
                        .distribution = {},
                        .choices = {{"a", {"/x=1"}, 2.0}, {"b", {"/x=2"}, 1.0}}},
                       {.name = "lattice",
                        .kind = ParameterKind::numerical,
                        .entries = {},
                        .distribution = {},
                        .choices = {},
                        .lattices = 6}};
    std::map<std::string, int> motions;
    std::map<double, int> lattices;
    for (const DrawnSample& each : samples_of(plan, 60)) {
        ++motions[values_of(plan, each).at("motion").get<std::string>()];
        ++lattices[each.draws[1]];
    }
    EXPECT_EQ(motions, (std::map<std::string, int>{{"a", 40}, {"b", 20}}));
    ASSERT_EQ(lattices.size(), 6u);
    for (const auto& [lattice, count] : lattices) EXPECT_EQ(count, 10) << lattice;
}

TEST(Samples, AreTheSameOnEveryMachine) {
    // Written down once: with other numbers the same seed would draw another study.
    const Points cube = latin_hypercube(4, 4, 1, 7);
    const std::vector<double> drawn{0.55055943378086536, 0.91635354718279849, 0.36814719443571819,
                                    0.0015524645651292523};
    for (std::size_t i = 0; i < drawn.size(); ++i) EXPECT_EQ(cube[i][0], drawn[i]);
    EXPECT_EQ(sobol_points(1, 2, 7)[0],
              (std::vector<double>{0.85091535456012934, 0.30026940803509206}));
    EXPECT_EQ(name_of_sample(1), "s0001");
    EXPECT_EQ(name_of_sample(12345), "s12345");
}

}  // namespace
}  // namespace breach::orchestrator::sampling_test
