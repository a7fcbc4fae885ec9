// The surrogate and its tornado for known functions.
#include "core/statistics/surrogate.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

namespace breach::statistics::surrogate_test {
namespace {

/// Two lognormal numbers with medians 1 and 5, and a choice of three.
struct Samples {
    std::array<Drawn, 3> parameters{Drawn{.name = "strength", .values = {}},
                                    Drawn{.name = "viscosity", .values = {}},
                                    Drawn{.name = "motion", .is_choice = true, .values = {}}};
    explicit Samples(int count) {
        std::mt19937_64 generator(7);
        std::normal_distribution<double> normal;
        for (int i = 0; i < count; ++i) {
            parameters[0].values.push_back(std::exp(0.3 * normal(generator)));
            parameters[1].values.push_back(5.0 * std::exp(0.8 * normal(generator)));
            parameters[2].values.push_back(i % 4 == 3 ? 2 : i % 4 % 2);  // option 0 twice as often
        }
    }
    template <class Model>
    std::vector<double> results(Model model) const {
        std::vector<double> found;
        for (std::size_t i = 0; i < parameters[0].values.size(); ++i)
            found.push_back(model(std::log(parameters[0].values[i]) / 0.3,
                                  std::log(parameters[1].values[i] / 5.0) / 0.8,
                                  static_cast<int>(parameters[2].values[i])));
        return found;
    }
};

double model(double a, double b, int option) {
    const std::array<double, 3> of_option{0.0, 4.0, -2.0};
    return 20.0 - 3.0 * a + 1.0 * b + 0.5 * a * a + of_option[static_cast<std::size_t>(option)];
}

TEST(Surrogate, TornadoOfAKnownPolynomialIsItsOwn) {
    const Samples samples(400);
    const Tornado found = tornado_of(samples.parameters, samples.results(model));
    ASSERT_EQ(found.refused, "");
    EXPECT_GT(found.q2, 0.98);
    EXPECT_NEAR(found.at_median, 20.0, 0.3);
    ASSERT_EQ(found.bars.size(), 3u);
    EXPECT_EQ(found.bars[0].name, "strength") << "the widest first";
    constexpr double z = 1.2815515655446004;
    // The scores are those of the sample's ranks: with 400, percentiles are accurate to a few
    // hundredths.
    EXPECT_NEAR(found.bars[0].p10, model(-z, 0, 0), 0.5);
    EXPECT_NEAR(found.bars[0].p90, model(z, 0, 0), 0.5);
    EXPECT_EQ(found.bars[1].name, "motion");
    EXPECT_NEAR(found.bars[1].p10, 18.0, 0.4) << "its option with the smallest result";
    EXPECT_NEAR(found.bars[1].p90, 24.0, 0.4);
    EXPECT_EQ(found.bars[2].name, "viscosity");
    EXPECT_NEAR(found.bars[2].p10, model(0, -z, 0), 0.4);
    EXPECT_NEAR(found.bars[2].p90, model(0, z, 0), 0.4);
}

TEST(Surrogate, LeavesOutEachSampleAsAFitWithoutItWould) {
    const std::array<Drawn, 1> one{Drawn{.name = "x", .values = {1, 2, 3, 4, 5, 6}}};
    const std::vector<double> y{1, 3, 2, 5, 4, 7};
    const Tornado found = tornado_of(one, y);
    // numpy.polyfit(z, y, 1) of the other five samples for each, z = scipy.stats.norm.ppf(r / 7).
    EXPECT_NEAR(found.q2, 0.6261400069387595, 1e-9);
}

TEST(Surrogate, OfIshigamisFunctionIsRefused) {
    std::mt19937_64 generator(3);
    std::uniform_real_distribution<double> uniform(-std::numbers::pi, std::numbers::pi);
    std::array<Drawn, 3> parameters;
    std::vector<double> results;
    for (int i = 0; i < 200; ++i) {
        std::array<double, 3> x{uniform(generator), uniform(generator), uniform(generator)};
        for (std::size_t j = 0; j < 3; ++j) parameters[j].values.push_back(x[j]);
        results.push_back(std::sin(x[0]) * (1.0 + 0.1 * std::pow(x[2], 4)) +
                          7.0 * std::pow(std::sin(x[1]), 2));
    }
    const Tornado found = tornado_of(parameters, results);
    EXPECT_LT(found.q2, least_q2);
    EXPECT_TRUE(found.bars.empty());
    EXPECT_TRUE(found.refused.starts_with("Q2 is 0.")) << found.refused;
}

TEST(Surrogate, OfTooFewSamplesOrEqualResultsIsRefused) {
    const Samples few(7);
    EXPECT_EQ(tornado_of(few.parameters, few.results(model)).refused,
              "7 samples are too few for a surrogate of 3 parameters");
    const Samples samples(40);
    const Tornado same = tornado_of(samples.parameters, std::vector<double>(40, 1.0));
    EXPECT_EQ(same.refused, "the results do not vary");
}

}  // namespace
}  // namespace breach::statistics::surrogate_test
