// Undrained strength of NorSand against closed forms; a call with zero strain must not slow the
// next one.
#include "core/materials/norsand/undrained.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/verification/norsand/soils.hpp"

namespace breach::testing {
namespace {

using namespace norsand;
using mechanics::Voigt;

constexpr double sigma_v0 = 100e3, K_0 = 0.7, p_0 = (1.0 + 2.0 * K_0) / 3.0 * sigma_v0;
constexpr double far = 1e9;  // no bound

Ready cj1() {
    Parameters parameters = soil("CJ1");
    parameters.S = 1.0;
    return ready(parameters);
}
State at_rest(const Ready& law, double psi_0) {
    const Voigt sigma(-K_0 * sigma_v0, -sigma_v0, -K_0 * sigma_v0, 0.0);
    return initialise(law, sigma, psi_0 + critical_void_ratio(law, p_0)).state;
}

// docs/reference/methods/norsand.md, section 15: tau/sigma'_v0 = 0.039360 at psi_0 = 0.05, K_0 =
// 0.7.
TEST(NorSandUndrained, TheResidualIsThatOfTheCriticalState) {
    const Ready law = cj1();
    const materials::UndrainedStrength loose = undrained_strength(law, at_rest(law, 0.05), far);
    EXPECT_NEAR(loose.residual / sigma_v0, 0.039360, 5e-6);
    const double looser = undrained_strength(law, at_rest(law, 0.07), far).residual;
    EXPECT_NEAR(looser / loose.residual, std::exp(-1.0), 1e-9) << "e^(-d psi / lambda)";
}

TEST(NorSandUndrained, ThePeakIsThatOfThePathAndThePresentPastIt) {
    const Ready law = cj1();
    State state = at_rest(law, 0.05);
    const materials::UndrainedStrength found = undrained_strength(law, state, far);
    double peak = plane_shear(state);
    for (int step = 0; step < 4000; ++step) {
        state = integrate(law, state, Voigt(1e-5, -1e-5, 0.0, 0.0), {}).state;
        peak = std::max(peak, plane_shear(state));
    }
    EXPECT_NEAR(found.peak / peak, 1.0, 1e-3);
    EXPECT_GT(found.peak, 1.2 * plane_shear(at_rest(law, 0.05)));
    const double now = plane_shear(state);
    ASSERT_LT(now, 0.5 * peak);
    EXPECT_NEAR(undrained_strength(law, state, far).peak / now, 1.0, 1e-12);
}

/// H_0 50 and psi_0 -0.02: shear stress falls after its peak, then rises to the critical state.
struct Dip {
    Ready law = [] {
        Parameters parameters = soil("CJ1");
        parameters.semi_log->lambda = 0.1 / std::numbers::ln10;
        parameters.H_0 = 50.0, parameters.m = 0.5, parameters.S = 1.0;
        return ready(parameters);
    }();
    State start;
    double peak = 0.0, least;  ///< of its path in simple shear

    explicit Dip(double sigma_v) {
        const Voigt sigma = sigma_v * Voigt(-K_0, -1.0, -K_0, 0.0);
        const double p = (1.0 + 2.0 * K_0) / 3.0 * sigma_v;
        start = initialise(law, sigma, critical_void_ratio(law, p) - 0.02).state;
        State state = start;
        for (double shear = 0.0, before = -1.0; shear > before; shear = simple_shear(state)) {
            peak = before = shear;
            state = integrate(law, state, Voigt(0.0, 0.0, 0.0, 1e-5), {}).state;
        }
        least = peak;
        for (int step = 0; step < 3000; ++step) {
            state = integrate(law, state, Voigt(0.0, 0.0, 0.0, 1e-5), {}).state;
            least = std::min(least, simple_shear(state));
        }
    }
};

// Also at 100 kPa, where the fall is less than 10 % and the peak comes after it.
TEST(NorSandUndrained, TheResidualIsThePathsMinimumWhereShearStressRisesAgain) {
    for (const double sigma_v : {20e3, 100e3}) {
        const Dip dip(sigma_v);
        ASSERT_LT(dip.least, 0.97 * dip.peak) << sigma_v;
        const auto level = simple_shear_strength(dip.law, dip.start, far);
        EXPECT_NEAR(level.residual / dip.least, 1.0, 1e-3) << sigma_v;
        EXPECT_GT(level.peak, 0.99 * dip.peak) << sigma_v;
        const auto plane = undrained_strength(dip.law, dip.start, far);
        EXPECT_NEAR(plane.residual / dip.least, 1.0, 1e-3) << sigma_v;
    }
}

TEST(NorSandUndrained, ManySideBySideAreWhatEachAloneIs) {
    const Ready law = cj1();
    std::vector<State> states;
    std::vector<double> bounds;
    for (int i = 0; i < 37; ++i) {
        states.push_back(at_rest(law, -0.1 + 0.005 * i));
        bounds.push_back(i % 3 == 0 ? far : (1.0 + 0.1 * i) * p_0);
    }
    const auto together = undrained_strengths(law, states, bounds);
    ASSERT_EQ(together.size(), states.size());
    for (std::size_t i = 0; i < states.size(); ++i) {
        const materials::UndrainedStrength alone = undrained_strength(law, states[i], bounds[i]);
        EXPECT_EQ(together[i].peak, alone.peak) << i;
        EXPECT_EQ(together[i].residual, alone.residual) << i;
    }
}

TEST(NorSandUndrained, DenseSoilHasStrengthUpToTheBoundOnly) {
    const Ready law = cj1();
    const State dense = at_rest(law, -0.05);
    const materials::UndrainedStrength bounded = undrained_strength(law, dense, 2.0 * p_0);
    const double theta = plane_critical_angle(law);
    const double tau = critical_ratio(law, theta) * std::cos(theta) / std::numbers::sqrt3;
    EXPECT_NEAR(bounded.peak, tau * 2.0 * p_0, 1e-6);
    EXPECT_EQ(bounded.residual, bounded.peak);
    EXPECT_GT(undrained_strength(law, dense, far).peak, 2.0 * bounded.peak);
}

// A remaining guess of 1e-300 would use up the next call's evaluations in doublings.
TEST(NorSandUndrained, ACallOfNothingCostsTheNextOneNothing) {
    const Ready law = cj1();
    const State state = at_rest(law, 0.05);
    const Update nothing = integrate(law, state, Voigt::Zero(), {});
    ASSERT_EQ(nothing.outcome, Outcome::done);
    for (const double size : {1e-12, 1e-9, 1e-6, 1e-3}) {
        const Update next = integrate(law, nothing.state, Voigt(size, -size, 0.0, 0.0), {});
        EXPECT_EQ(next.outcome, Outcome::done) << size;
        EXPECT_LT(next.counts.evaluations, 200) << size;
    }
}

}  // namespace
}  // namespace breach::testing
