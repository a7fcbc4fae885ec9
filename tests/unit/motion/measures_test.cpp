// Measures of a motion against closed forms and an independent method.
#include "core/motion/measures.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "core/motion/read_motion.hpp"

namespace breach::motion::measures_test {
namespace {

using std::numbers::pi;

Series shipped() { return read_motion(BREACH_ROOT "/workflows/motions/synthetic.csv").series; }

/// Classical Runge-Kutta in steps of a 400th of the period or a 20th of the sample, whichever is
/// smaller.
double by_runge_kutta(const Series& a, double period, double xi) {
    const double w = 2.0 * pi / period, dt = std::min(period / 400.0, a.dt / 20.0);
    double u = 0.0, v = 0.0, largest = 0.0;
    const auto rate = [&](double t, double x, double y) {
        return -value_at(a, t) - 2.0 * xi * w * y - w * w * x;
    };
    for (double t = 0.0; t < a.duration(); t += dt) {
        const double k1 = rate(t, u, v), l1 = v;
        const double l2 = v + 0.5 * dt * k1, k2 = rate(t + 0.5 * dt, u + 0.5 * dt * l1, l2);
        const double l3 = v + 0.5 * dt * k2, k3 = rate(t + 0.5 * dt, u + 0.5 * dt * l2, l3);
        const double l4 = v + dt * k3, k4 = rate(t + dt, u + dt * l3, l4);
        u += dt / 6.0 * (l1 + 2.0 * l2 + 2.0 * l3 + l4);
        v += dt / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
        largest = std::max(largest, std::abs(u));
    }
    return w * w * largest;
}

TEST(Spectrum, IsThatOfAnotherIntegrationWithinHalfAPerCent) {
    const Series a = shipped();
    for (const double period : {0.05, 0.1, 0.3, 0.75, 1.5, 3.0, 5.0}) {
        const double other = by_runge_kutta(a, period, 0.05);
        EXPECT_NEAR(spectral_acceleration(a, period) / other, 1.0, 0.005) << period;
    }
}

TEST(Spectrum, OfAStiffOscillatorIsThePeakAcceleration) {
    const Series a = shipped();
    EXPECT_NEAR(spectral_acceleration(a, 0.01) / peak(a), 1.0, 0.02);
}

// Steady state: 1 / (2 xi) times the amplitude; after n cycles it has grown to 1 - exp(-2 pi xi n).
TEST(Spectrum, ResonatesAsTheClosedFormSays) {
    constexpr double period = 0.5, xi = 0.05;
    constexpr int cycles = 10;
    Series a{0.001, {}};
    for (int i = 0; i <= cycles * 500; ++i)
        a.values.push_back(std::sin(2.0 * pi * i * a.dt / period));
    const double expected = (1.0 - std::exp(-2.0 * pi * xi * cycles)) / (2.0 * xi);
    EXPECT_NEAR(spectral_acceleration(a, period, xi) / expected, 1.0, 0.01);
}

TEST(Measures, OfASineAreTheClosedForms) {
    constexpr double A = 2.0, f = 2.0;
    Series a{0.001, {}};
    for (int i = 0; i <= 5000; ++i) a.values.push_back(A * std::sin(2.0 * pi * f * i * a.dt));
    const Measures all = measures_of(a);
    EXPECT_NEAR(all.pga, A, 1e-5);
    EXPECT_NEAR(all.pgv, A / (pi * f), 1e-5);
    EXPECT_NEAR(all.cav, 2.0 / pi * A * 5.0, 1e-3);
    EXPECT_NEAR(all.arias, pi / (2.0 * standard_gravity) * 0.5 * A * A * 5.0, 1e-4);
    EXPECT_NEAR(all.strong.duration(), 0.9 * 5.0, 0.1);
}

TEST(Measures, GrowInProportionToTheMotion) {
    const Series a = shipped();
    const Measures one = measures_of(a), two = measures_of(scaled_to_peak(a, 2.0 * peak(a)));
    EXPECT_NEAR(two.masi / one.masi, 2.0, 1e-9);
    EXPECT_NEAR(two.cav / one.cav, 2.0, 1e-9);
    EXPECT_NEAR(two.arias / one.arias, 4.0, 1e-9);
    EXPECT_NEAR(two.pgd / one.pgd, 2.0, 1e-9);
    EXPECT_GT(one.masi, 0.0);
    EXPECT_EQ(as_json(one).at("spectrum").at("period").size(), one.spectrum.size());
}

TEST(Samples, AtUnequalTimesBecomeEquallySpaced) {
    const Series s = equally_spaced({0.1, 0.25, 0.4}, {1.0, 2.5, 4.0}, 0.1);
    ASSERT_EQ(s.values.size(), 5U);
    EXPECT_NEAR(s.values[2], 2.0, 1e-12);
    EXPECT_NEAR(s.values[4], 4.0, 1e-12);
    const Series slope = derivative(s);
    EXPECT_NEAR(slope.values[3], 10.0, 1e-9);
}

}  // namespace
}  // namespace breach::motion::measures_test
