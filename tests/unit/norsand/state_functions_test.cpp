// The state functions of NorSand against the formulas of docs/reference/methods/norsand.md in terms
// of angles, and the initial state of a point.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/materials/norsand/functions.hpp"
#include "tests/verification/norsand/soils.hpp"

namespace breach::testing {
namespace {

using namespace norsand;
using mechanics::Voigt;
using std::numbers::pi;

constexpr double degree = pi / 180.0;
constexpr double tip = std::numbers::e;

/// A stress on the surface of a soil at mean stress p [Pa], ratio eta and Lode angle theta, with
/// principal axes turned by `turn`; the middle stress out of the plane.
Voigt stress_at(double p, double eta, double theta, double turn) {
    const double q = eta * p;
    const double s_1 = 2.0 / 3.0 * q * std::sin(pi / 3.0 + theta);
    const double s_3 = -2.0 / 3.0 * q * std::sin(pi / 3.0 - theta);
    const double s_2 = -2.0 / 3.0 * q * std::sin(theta);
    const double half = 0.5 * (s_1 - s_3), centre = p + 0.5 * (s_1 + s_3);
    return -Voigt(centre + half * std::cos(2.0 * turn), centre - half * std::cos(2.0 * turn),
                  p + s_2, half * std::sin(2.0 * turn));
}

TEST(NorSandFunctions, CriticalRatioIsThatOfJefferiesAndShuttle) {
    const Ready law = ready(soil("CJ1"));
    EXPECT_NEAR(critical_ratio(law, 30.0 * degree), 1.2, 1e-15);
    EXPECT_NEAR(critical_ratio(law, -30.0 * degree), 3.6 / 4.2, 1e-15);
    for (double theta = -29.9; theta < 30.0; theta += 3.7) {
        const State state = initialise(law, stress_at(100e3, 0.3, theta * degree, 0.4), 0.8).state;
        const Reading seen = read(law, state);
        EXPECT_NEAR(seen.theta, theta * degree, 1e-12);
        EXPECT_NEAR(seen.M, critical_ratio(law, theta * degree), 1e-13);
        EXPECT_NEAR(seen.p, 100e3, 1e-7);
        EXPECT_NEAR(seen.q, 30e3, 1e-7);
    }
}

TEST(NorSandFunctions, CriticalAnglesOfPlaneStrainAreThoseOfTheDesignPage) {
    Parameters parameters = soil("CJ1");
    EXPECT_NEAR(plane_critical_angle(ready(parameters)) / degree, 17.019, 1e-3);
    parameters.flow = FlowRule::radial;
    EXPECT_EQ(plane_critical_angle(ready(parameters)), 0.0);
    parameters.flow = FlowRule::normal;
    EXPECT_NEAR(plane_critical_angle(ready(parameters)) / degree, 23.905, 1e-3);
}

/// Surface and flow at a stress, with the strain-rate ratios written in angles.
struct Looked {
    Surface<double> surface;
    Flow<double> flow;
};
Looked look(const Ready& law, const State& state) {
    const Place<double> place{
        {state.xx, state.yy, state.zz, state.xy}, state.p_i, state.e, state.chi_i};
    Looked out{surface_at(law, place, {0.0, 0.0, 0.0, 0.0}), {}};
    out.flow = flow_at(law, place, out.surface);
    return out;
}

TEST(NorSandFunctions, PlasticStrainIsConjugateAndHasTheDilatancyOfTheSurface) {
    for (const FlowRule rule : {FlowRule::js, FlowRule::radial, FlowRule::normal}) {
        Parameters parameters = soil("CJ1");
        parameters.flow = rule;
        const Ready law = ready(parameters);
        for (double theta = -29.0; theta < 30.0; theta += 4.3) {
            for (const double e : {0.70, 0.80, 0.85}) {
                const State state =
                    initialise(law, stress_at(100e3, 0.6, theta * degree, 1.1), e).state;
                const auto [at, flow] = look(law, state);
                const Reading seen = read(law, state);
                EXPECT_NEAR(flow.D, seen.M_i - seen.q / seen.p, 1e-12);
                EXPECT_NEAR(trace(flow.r), 0.0, 1e-13);
                const double work = double_dot(at.s, flow.r) + at.s.xy * flow.r.xy;
                EXPECT_NEAR(work / at.q, 1.0, 1e-12);
            }
        }
    }
}

TEST(NorSandFunctions, RatiosOfJefferiesAndShuttleAreThoseOfTheTriaxialTestAtItsLines) {
    const Ready law = ready(soil("CJ1"));
    for (const double theta : {30.0 * degree, -30.0 * degree}) {
        const auto [at, flow] =
            look(law, initialise(law, stress_at(100e3, 0.5, theta, 0.0), 0.8).state);
        // Two equal lateral strains.
        const double axial = theta > 0.0 ? 1.0 : -1.0;
        EXPECT_NEAR(theta > 0.0 ? flow.r.xx : flow.r.yy, axial, 1e-9);
        EXPECT_NEAR(flow.r.zz, -0.5 * axial, 1e-9);
    }
}

TEST(NorSandFunctions, CriticalStateInPlaneStrainHasNoStrainAcrossThePlane) {
    const Ready law = ready(soil("CJ1"));
    const double theta = plane_critical_angle(law);
    const double M = critical_ratio(law, theta);
    const double e = critical_void_ratio(law, 100e3);
    const State state = initialise(law, stress_at(100e3, 0.97 * M, theta, 0.3), e).state;
    Place<double> place{{state.xx, state.yy, state.zz, state.xy}, 0.0, e, state.chi_i};
    const Voigt critical = -stress_at(100e3, M, theta, 0.3);
    place.sigma = {critical[0], critical[1], critical[2], critical[3]};
    place.p_i = 100e3;
    const auto surface = surface_at(law, place, {0.0, 0.0, 0.0, 0.0});
    const auto flow = flow_at(law, place, surface);
    EXPECT_NEAR(surface.F, 0.0, 1e-6);
    EXPECT_NEAR(flow.D, 0.0, 1e-9);
    EXPECT_NEAR(flow.r.zz, 0.0, 1e-9);
}

TEST(NorSandFunctions, GradientIsTheDerivativeOfTheYieldFunction) {
    const Ready law = ready(soil("CJ1"));
    const State state = initialise(law, stress_at(100e3, 0.6, 0.2, 0.7), 0.82).state;
    const auto [at, flow] = look(law, state);
    const auto F = [&](double Voigt_xx, double yy, double zz, double xy) {
        State moved = state;
        moved.xx = Voigt_xx, moved.yy = yy, moved.zz = zz, moved.xy = xy;
        return read(law, moved).F;
    };
    const double h = 1.0;
    const double third = flow.D / 3.0;
    const State& s = state;
    EXPECT_NEAR((F(s.xx + h, s.yy, s.zz, s.xy) - F(s.xx - h, s.yy, s.zz, s.xy)) / (2.0 * h),
                third + flow.n.xx, 1e-8);
    EXPECT_NEAR((F(s.xx, s.yy + h, s.zz, s.xy) - F(s.xx, s.yy - h, s.zz, s.xy)) / (2.0 * h),
                third + flow.n.yy, 1e-8);
    EXPECT_NEAR((F(s.xx, s.yy, s.zz + h, s.xy) - F(s.xx, s.yy, s.zz - h, s.xy)) / (2.0 * h),
                third + flow.n.zz, 1e-8);
    EXPECT_NEAR((F(s.xx, s.yy, s.zz, s.xy + h) - F(s.xx, s.yy, s.zz, s.xy - h)) / (2.0 * h),
                flow.n.xy, 1e-8);
    State moved = state;
    moved.e += 1e-6;
    const double up = read(law, moved).F;
    moved.e -= 2e-6;
    EXPECT_NEAR((up - read(law, moved).F) / 2e-6 / flow.F_e, 1.0, 1e-7);
}

TEST(NorSandBeginning, LiesOnTheSurfaceAndOverconsolidationMovesTheSurfaceAlone) {
    for (const char* name : {"CJ1", "CJ2", "NK", "TC"}) {
        const Ready law = ready(soil(name));
        const Voigt sigma = stress_at(150e3, 0.5, 0.1, 0.3);
        const double e = 0.02 + critical_void_ratio(law, 150e3);
        const State one = initialise(law, sigma, e).state;
        EXPECT_NEAR(read(law, one).F / 150e3, 0.0, 1e-12) << name;
        EXPECT_NEAR((stress(one) - sigma).norm() / 150e3, 0.0, 1e-14);
        EXPECT_NEAR(read(law, one).psi, 0.02, 1e-13);
        const Beginning over = initialise(law, sigma, e, 1.1);
        EXPECT_NEAR(over.state.p_i / one.p_i, 1.1, 1e-12);
        EXPECT_LT(read(law, over.state).F, 0.0);
        EXPECT_FALSE(over.clipped);
        const Beginning far = initialise(law, sigma, e, 50.0);
        EXPECT_TRUE(far.clipped);
        EXPECT_NEAR(far.state.p_i / read(law, far.state).p_mx, 1.0, 1e-9) << name;
        const State isotropic = initialise(law, Voigt(-80e3, -80e3, -80e3, 0.0), e).state;
        EXPECT_NEAR(isotropic.p_i * tip / 80e3, 1.0, 1e-14);
    }
}

TEST(NorSandBeginning, StressesBeyondTheLimitAreShrunkAndReported) {
    const Ready law = ready(soil("CJ1"));
    const double nu = 0.15, K0 = nu / (1.0 - nu);
    const Voigt sigma(-K0 * 200e3, -200e3, -K0 * 200e3, 0.0);
    const double p = (1.0 + 2.0 * K0) / 3.0 * 200e3;
    const Beginning begun = initialise(law, sigma, 0.05 + critical_void_ratio(law, p));
    EXPECT_TRUE(begun.shrunk);
    EXPECT_NEAR(begun.eta, 3.0 * (1.0 - K0) / (1.0 + 2.0 * K0), 1e-12);
    const Reading seen = read(law, begun.state);
    EXPECT_NEAR(seen.p, p, 1e-6);
    EXPECT_NEAR(seen.q / seen.p, 0.98 * std::min(seen.eta_L, seen.M_i), 1e-9);
    EXPECT_NEAR(seen.F / p, 0.0, 1e-9);
    const Beginning low = initialise(law, Voigt(-100.0, -100.0, -100.0, 0.0), 0.9);
    EXPECT_TRUE(low.raised);
    EXPECT_NEAR(read(law, low.state).p, 500.0, 1e-9);
}

TEST(NorSandFunctions, FirstDrainedIncrementIsTheClosedForm) {
    // From isotropic stress D = M_i, and d eta / d epsilon_q = M_i H e^2 (p_mx/p - 1/e) / (1 +
    // M_i/3) without the rate of M_i: N = 0.
    Parameters parameters = soil("CJ1");
    parameters.N = 0.0;
    const auto start = specimen(parameters, 100e3, 1.0, -0.05, {.tolerance = 1e-9});
    const Reading at = reading(start);
    const double held =
        element_bench::held_stress(start, element_bench::Boundary::drained_compression);
    const auto trial =
        element_bench::driven(start, element_bench::Boundary::drained_compression, 1e-8, held);
    const Reading after = reading(trial.specimen);
    const double d_epsilon_q = state_of(trial.specimen).epsilon_q;
    EXPECT_NEAR(at.D, at.M_i, 1e-12);
    const double rate =
        at.M_i * 300.0 * tip * tip * (at.p_mx / at.p - 1.0 / tip) / (1.0 + at.M_i / 3.0);
    EXPECT_NEAR(after.q / after.p / d_epsilon_q / rate, 1.0, 1e-4);
}

}  // namespace
}  // namespace breach::testing
