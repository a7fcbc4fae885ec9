// Scatter of a curve about itself, without repeats.
#include "core/statistics/neighbours.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace breach::statistics::neighbours_test {
namespace {

TEST(Neighbours, AStraightLineScattersByNothingHoweverItIsSampled) {
    std::vector<CurvePoint> line;
    for (const double x : {0.0, 0.1, 0.5, 0.55, 2.0, 2.4}) line.push_back({x, 7.0 - 3.0 * x});
    for (const auto& each : scatter_among_neighbours(line)) EXPECT_NEAR(each.value(), 0.0, 1e-12);
}

TEST(Neighbours, NoiseOnASlowCurveIsFoundAsItWasMade) {
    std::mt19937_64 chance(1);
    std::normal_distribution<double> normal(0.0, 3.0);
    std::uniform_real_distribution<double> step(0.5, 1.5);
    std::vector<CurvePoint> curve;
    for (double x = 0.0; curve.size() < 4000; x += step(chance))
        curve.push_back({x, 100.0 * std::sin(x / 200.0) + normal(chance)});
    double squares = 0.0;
    for (const auto& each : scatter_among_neighbours(curve)) squares += each.value() * each.value();
    EXPECT_NEAR(std::sqrt(squares / 4000.0), 3.0, 0.15);
}

TEST(Neighbours, OneThatStandsOutIsSeenWhereItStands) {
    std::vector<CurvePoint> curve;
    for (int i = 0; i < 20; ++i) curve.push_back({0.05 * i, i == 10 ? 40.0 : 100.0});
    const auto scatter = scatter_among_neighbours(curve);
    // Deviations of -60 there and 30 on both sides.
    const double expected = std::sqrt((60.0 * 60.0 + 2 * 30.0 * 30.0) / 1.5 / 5.0);
    EXPECT_NEAR(scatter[10].value(), expected, 1e-9);
    EXPECT_NEAR(scatter[6].value(), 0.0, 1e-9);
    EXPECT_GT(scatter[8].value(), 10.0);
    EXPECT_NEAR(scatter[14].value(), 0.0, 1e-9);
}

TEST(Neighbours, FewerThanFiveGiveNoNoise) {
    const std::vector<CurvePoint> few{{0, 1}, {1, 2}, {2, 1}, {3, 2}};
    for (const auto& each : scatter_among_neighbours(few)) EXPECT_FALSE(each);
    EXPECT_TRUE(scatter_among_neighbours({}).empty());
}

}  // namespace
}  // namespace breach::statistics::neighbours_test
