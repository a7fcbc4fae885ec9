// Importance against scipy 1.10.1 and closed forms. scipy and numpy gave, for
//   a = (7 i) % 40, b = (11 i i) % 17, g = i % 3, y = a + b^2 / 34 + 10 [g == 1] + (29 i) % 23,
//   i = 0 ... 39:
// scipy.stats.spearmanr(a, y) and (b, y); the correlation of what numpy.linalg.lstsq on
// [1, rankdata(b), g == 1, g == 2] leaves of rankdata(a) and rankdata(y); and epsilon squared of y
// over g from scipy.stats.f_oneway's F.
#include "core/statistics/importance.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

namespace breach::statistics::importance_test {
namespace {

struct Known {
    std::array<Drawn, 3> parameters{Drawn{.name = "a", .values = {}},
                                    Drawn{.name = "b", .values = {}},
                                    Drawn{.name = "g", .is_choice = true, .values = {}}};
    std::vector<double> results;
    Known() {
        for (int i = 0; i < 40; ++i) {
            const double a = (7 * i) % 40;
            const double b = (11 * i * i) % 17;
            parameters[0].values.push_back(a);
            parameters[1].values.push_back(b);
            parameters[2].values.push_back(i % 3);
            results.push_back(a + b * b / 34.0 + (i % 3 == 1 ? 10.0 : 0.0) + (29 * i) % 23);
        }
    }
};

TEST(Importance, RankCorrelationsAreScipys) {
    const Known known;
    const auto found = importance_of(known.parameters, known.results);
    EXPECT_NEAR(found[0].rank_correlation->value, 0.8362101313320827, 1e-12);
    EXPECT_NEAR(found[1].rank_correlation->value, 0.021901693636487057, 1e-12);
    EXPECT_NEAR(found[0].partial_rank_correlation->value, 0.8730351646182145, 1e-12);
    EXPECT_NEAR(found[0].partial_rank_correlation->low, 0.7674896449165226, 1e-12);
    EXPECT_NEAR(found[0].partial_rank_correlation->high, 0.9324991958807121, 1e-12);
}

TEST(Importance, OfAChoiceIsItsCorrelationRatioAndNoRankCorrelation) {
    const Known known;
    const Importance found = importance_of(known.parameters, known.results)[2];
    EXPECT_FALSE(found.rank_correlation || found.partial_rank_correlation);
    EXPECT_NEAR(found.first_order->value, 0.17815740097237465, 1e-12);
}

/// Coverage of the closed form by the intervals of the first-order indices, over `seeds` seeds.
struct Model {
    std::function<double(std::mt19937_64&)> draw;
    std::function<double(const std::array<double, 3>&)> result;
    std::array<double, 3> first_order;
};

std::array<int, 3> covered(const Model& model, std::size_t samples, int seeds) {
    std::array<int, 3> found{};
    for (int seed = 0; seed < seeds; ++seed) {
        std::mt19937_64 generator(static_cast<std::uint64_t>(seed));
        std::array<Drawn, 3> parameters;
        std::vector<double> results;
        for (std::size_t i = 0; i < samples; ++i) {
            std::array<double, 3> x{};
            for (std::size_t j = 0; j < 3; ++j) {
                x[j] = model.draw(generator);
                parameters[j].values.push_back(x[j]);
            }
            results.push_back(model.result(x));
        }
        const auto importance = importance_of(parameters, results);
        for (std::size_t j = 0; j < 3; ++j) {
            const Interval& each = importance[j].first_order.value();
            const double wanted = model.first_order[j];
            found[j] += each.low <= wanted && wanted <= each.high ? 1 : 0;
        }
    }
    return found;
}

/// 90 % of 100 seeds, minus three standard deviations of the binomial. An index of zero is covered
/// more often, as the lower end of its range.
constexpr int seeds = 100;
constexpr int least_kept = 81;

TEST(Importance, IntervalsCoverTheIndicesOfALinearModel) {
    const Model linear{.draw =
                           [](std::mt19937_64& generator) {
                               return std::normal_distribution<double>()(generator);
                           },
                       .result = [](const auto& x) { return 2.0 * x[0] + x[1]; },
                       .first_order = {0.8, 0.2, 0.0}};
    for (const std::size_t samples : {64u, 256u})
        for (const int each : covered(linear, samples, seeds)) EXPECT_GE(each, least_kept);
}

TEST(Importance, IntervalsCoverTheIndicesOfIshigamisFunction) {
    constexpr double pi = std::numbers::pi;
    const double a = 7.0, b = 0.1;
    // Closed forms: Saltelli et al. 2008, 4.6; Homma & Saltelli 1996.
    const double of_1 = 0.5 * std::pow(1.0 + b * std::pow(pi, 4) / 5.0, 2);
    const double of_2 = a * a / 8.0;
    const double of_1_and_3 = b * b * std::pow(pi, 8) * 8.0 / 225.0;
    const double all = of_1 + of_2 + of_1_and_3;
    const Model ishigami{.draw =
                             [](std::mt19937_64& generator) {
                                 return std::uniform_real_distribution<double>(-pi, pi)(generator);
                             },
                         .result =
                             [&](const auto& x) {
                                 const double second = std::sin(x[1]);
                                 return std::sin(x[0]) * (1.0 + b * std::pow(x[2], 4)) +
                                        a * second * second;
                             },
                         .first_order = {of_1 / all, of_2 / all, 0.0}};
    for (const std::size_t samples : {64u, 256u})
        for (const int each : covered(ishigami, samples, seeds)) EXPECT_GE(each, least_kept);
}

TEST(Importance, WithTooFewSamplesOrNothingThatVariesThereIsNone) {
    std::array<Drawn, 1> one{Drawn{.name = "x", .values = {1, 2, 3}}};
    EXPECT_FALSE(importance_of(one, std::array{1.0, 2.0, 3.0})[0].rank_correlation);
    one[0].values = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
    const std::vector<double> same(12, 3.0);
    EXPECT_FALSE(importance_of(one, same)[0].first_order);
    // a different option in every sample: the options' importance is unknown
    one[0].is_choice = true;
    EXPECT_FALSE(importance_of(one, one[0].values)[0].first_order);
}

}  // namespace
}  // namespace breach::statistics::importance_test
