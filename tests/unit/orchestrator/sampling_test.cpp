// The samples of a plan.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "services/orchestrator/study/samples.hpp"

namespace breach::orchestrator::sampling_test {
namespace {

UncertaintyPlan plan_of(std::size_t samples, double rank, Sampling sampling) {
    UncertaintyPlan plan;
    plan.samples = plan.drawn = plan.first = samples;
    plan.seed = 11;
    plan.sampling = sampling;
    for (const char* name : {"strength", "viscosity", "friction", "density"})
        plan.parameters.push_back(
            {.name = name,
             .kind = ParameterKind::value,
             .entries = {},
             .distribution = {statistics::DistributionKind::lognormal, {1.0, 0.5}, {}},
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
    const statistics::Matrix wanted = correlation_matrix(plan);
    double worst = 0.0;
    for (std::size_t a = 0; a < 4; ++a)
        for (std::size_t b = 0; b < a; ++b)
            worst = std::max(worst, std::abs(statistics::rank_correlation(column(samples, a),
                                                                          column(samples, b)) -
                                             wanted[a][b]));
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

TEST(Samples, AreNamedInFourDigits) {
    EXPECT_EQ(name_of_sample(1), "s0001");
    EXPECT_EQ(name_of_sample(12345), "s12345");
}

}  // namespace
}  // namespace breach::orchestrator::sampling_test
