#include "core/materials/mohr_coulomb/mohr_coulomb.hpp"

#include <gtest/gtest.h>

#include <set>

#include "tests/unit/materials/rotated_stress.hpp"
#include "tests/unit/materials/samples.hpp"

namespace breach::materials::mohr_coulomb_test {
namespace {

using samples::degree;
using samples::soil;

State admissible_state(const MohrCoulomb& law, samples::Draw& draw) {
    return integrate(law, State{Voigt::Zero()}, draw.strain(1e-2)).state;
}

double scale_of(const MohrCoulomb& law, const State& old, const Voigt& d_epsilon) {
    return old.sigma.cwiseAbs().maxCoeff() + law.c +
           mechanics::elastic_stress(law.elasticity, d_epsilon).cwiseAbs().maxCoeff();
}

// Only the round-off of the trial stress remains: 1e-13 of the largest stress is a few hundred
// units in the last place.
constexpr double round_off = 1e-13;

TEST(MohrCoulomb, ReturnedStressIsAdmissibleAndOnTheSurface) {
    samples::Draw draw(10);
    std::set<Return> kinds;
    for (const MohrCoulomb& law : samples::soils()) {
        for (int n = 0; n < 400; ++n) {
            const State old = admissible_state(law, draw);
            const Voigt d_epsilon = draw.strain(1e2);
            const Update update = integrate(law, old, d_epsilon);
            kinds.insert(update.kind);
            ASSERT_TRUE(update.state.sigma.allFinite());
            ASSERT_TRUE(std::isfinite(update.state.epsilon_q));
            const double excess = yield_excess(law, update.state);
            const double scale = scale_of(law, old, d_epsilon);
            ASSERT_LE(excess, round_off * scale);
            if (update.kind != Return::elastic) {
                ASSERT_GE(excess, -round_off * scale);
            }
        }
    }
    EXPECT_EQ(kinds.size(), 6u) << "elastic, plane, two edges, apex, tension";
}

TEST(MohrCoulomb, ReturningTwiceChangesNothing) {
    samples::Draw draw(11);
    for (const MohrCoulomb& law : samples::soils()) {
        for (int n = 0; n < 200; ++n) {
            const Voigt d_epsilon = draw.strain(1e2);
            const State once = integrate(law, State{Voigt::Zero()}, d_epsilon).state;
            const State twice = integrate(law, once, Voigt::Zero()).state;
            const double scale = scale_of(law, State{Voigt::Zero()}, d_epsilon);
            ASSERT_LT((once.sigma - twice.sigma).cwiseAbs().maxCoeff(), 4.0 * round_off * scale);
        }
    }
}

TEST(MohrCoulomb, StressIsTheTrialLessDTimesThePlasticStrain) {
    samples::Draw draw(12);
    for (const MohrCoulomb& law : samples::soils()) {
        for (int n = 0; n < 200; ++n) {
            const State old = admissible_state(law, draw);
            const Voigt d_epsilon = draw.strain(1e2);
            const Update update = integrate(law, old, d_epsilon);
            const Voigt expected =
                old.sigma +
                mechanics::elastic_stress(law.elasticity, d_epsilon - update.d_epsilon_plastic);
            // the strain difference is multiplied by lambda, which is 1700 E at nu = 0.4999
            ASSERT_LT((update.state.sigma - expected).cwiseAbs().maxCoeff(),
                      10.0 * round_off *
                          (scale_of(law, old, d_epsilon) +
                           scale_of(law, old, Voigt::Constant(d_epsilon.norm()))));
        }
    }
}

TEST(MohrCoulomb, DoesNotSeeTheFrame) {
    samples::Draw draw(13);
    for (const MohrCoulomb& law : samples::soils()) {
        for (int n = 0; n < 100; ++n) {
            const State old = admissible_state(law, draw);
            const Voigt d_epsilon = draw.strain(1.0);
            const double angle = draw.uniform(-4, 4);
            const auto turned_strain = [&](Voigt e) {  // engineering shear
                e[3] *= 0.5;
                e = rotated_stress(e, angle);
                e[3] *= 2.0;
                return e;
            };
            const Update here = integrate(law, old, d_epsilon);
            const Update there =
                integrate(law, State{rotated_stress(old.sigma, angle), old.epsilon_q},
                          turned_strain(d_epsilon));
            const double scale = scale_of(law, old, d_epsilon) +
                                 law.elasticity.constrained_modulus() * d_epsilon.norm();
            ASSERT_LT(
                (rotated_stress(here.state.sigma, angle) - there.state.sigma).cwiseAbs().maxCoeff(),
                10.0 * round_off * scale);
            ASSERT_NEAR(here.state.epsilon_q, there.state.epsilon_q,
                        10.0 * round_off * scale / law.elasticity.shear_modulus());
        }
    }
}

TEST(MohrCoulomb, PlasticWorkIsNeverNegative) {
    samples::Draw draw(14);
    for (const MohrCoulomb& law : samples::soils()) {
        for (int n = 0; n < 200; ++n) {
            const State old = admissible_state(law, draw);
            const Voigt d_epsilon = draw.strain(1e-1);
            const Update update = integrate(law, old, d_epsilon);
            const double work = update.state.sigma.dot(update.d_epsilon_plastic);
            const double scale = scale_of(law, old, d_epsilon);
            ASSERT_GE(work, -round_off * scale * scale / law.elasticity.shear_modulus());
        }
    }
}

TEST(MohrCoulomb, DilatesAtItsDilatancyAngleOnThePlane) {
    const double psi = 12 * degree;
    const MohrCoulomb law{{2e7, 0.3}, 1e4, 30 * degree, psi, 0.0, std::nullopt};
    const State confined{{-1e5, -1e5, -1e5, 0.0}};
    // In simple shear the out-of-plane stress stays intermediate: one plane, plane plastic strain.
    const Update update = integrate(law, confined, {0.0, 0.0, 0.0, 0.05});
    ASSERT_EQ(update.kind, Return::plane);
    const Voigt& e = update.d_epsilon_plastic;
    const double gamma = std::hypot(e[0] - e[1], e[3]);
    EXPECT_NEAR((e[0] + e[1]) / gamma, std::sin(psi), 1e-12);
    EXPECT_EQ(e[2], 0.0);
}

TEST(MohrCoulomb, YieldsAtTheCoulombLineInBiaxialCompression) {
    const MohrCoulomb law = soil(30, 0, 5e3, 0.0);
    const double k = 3.0;
    const double q = 2.0 * 5e3 * std::sqrt(k);
    State state{{-5e4, -5e4, -5e4, 0.0}};
    for (int n = 0; n < 50; ++n) state = integrate(law, state, {1e-3, -1e-3, 0.0, 0.0}).state;
    EXPECT_NEAR(k * state.sigma[0] - state.sigma[1], q, 1e-12 * 5e4);
    // Without volume change the mean of the in-plane stresses stays that of the elastic path.
    EXPECT_NEAR(0.5 * (state.sigma[0] + state.sigma[1]), -5e4, 1e-12 * 5e4);
}

TEST(MohrCoulomb, ZeroStrengthIsAFluid) {
    const MohrCoulomb law = soil(0, 0, 0.0, 0.0, 0.4999);
    const Update pressed = integrate(law, State{Voigt::Zero()}, {-1e-3, -3e-3, 0.0, 5e-3});
    const double p = -law.elasticity.bulk_modulus() * -4e-3;
    // K dv against shear stresses 5000 times smaller that vanish exactly
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(pressed.state.sigma[i], -p, 1e-9 * p);
    EXPECT_NEAR(pressed.state.sigma[3], 0.0, 1e-9 * p);
    const Update pulled = integrate(law, State{Voigt::Zero()}, {1e-3, 3e-3, 0.0, 5e-3});
    EXPECT_NEAR(pulled.state.sigma.cwiseAbs().maxCoeff(), 0.0, 1e-9 * p);
}

TEST(MohrCoulomb, SmallStepsAndOneStepAgreeOnAProportionalPlanePath) {
    const MohrCoulomb law = soil(30, 10, 1e4, 0.0);
    const State start{{-1e5, -1e5, -1e5, 0.0}};
    const Voigt path{0.0, 0.0, 0.0, 0.02};
    const State once = integrate(law, start, path).state;
    State many = start;
    for (int n = 0; n < 1000; ++n) many = integrate(law, many, path / 1000.0).state;
    // The axes rotate along the path, so the two differ by that rotation; both must be on the
    // surface.
    EXPECT_NEAR(yield_excess(law, many), 0.0, 1e-9);
    EXPECT_NEAR(yield_excess(law, once), 0.0, 1e-9);
    EXPECT_LT((many.sigma - once.sigma).norm() / once.sigma.norm(), 0.1);
}

TEST(MohrCoulomb, ReadyLawGivesTheSameDigits) {
    samples::Draw draw(15);
    for (const MohrCoulomb& law : samples::soils()) {
        const MohrCoulombNumbers prepared = ready(law);
        for (int n = 0; n < 20; ++n) {
            const State old = admissible_state(law, draw);
            const Voigt d_epsilon = draw.strain(1e-2);
            Matrix4 tangent;
            const Voigt sigma = integrate(law, old, d_epsilon).state.sigma;
            ASSERT_EQ(sigma, integrate(prepared, old, d_epsilon).state.sigma);
            ASSERT_EQ(sigma, integrate(prepared, old, d_epsilon, tangent).state.sigma);
        }
    }
}

}  // namespace
}  // namespace breach::materials::mohr_coulomb_test
