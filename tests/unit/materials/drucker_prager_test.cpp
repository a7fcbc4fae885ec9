// Drucker-Prager compared with Mohr-Coulomb in plane-strain flow, to which it is fitted.
#include "core/materials/drucker_prager/drucker_prager.hpp"

#include <gtest/gtest.h>

#include <map>

#include "tests/unit/materials/samples.hpp"

namespace breach::materials::drucker_prager_test {
namespace {

using samples::degree;

DruckerPrager soil(double phi_deg, double psi_deg, double c, double cut_off, double nu = 0.3) {
    return {{2e7, nu}, c, phi_deg * degree, psi_deg * degree, cut_off};
}

std::vector<DruckerPrager> soils() {
    std::vector<DruckerPrager> all;
    for (const double cut_off : {0.0, 3e3, samples::no_cut_off}) {
        for (const double nu : {0.0, 0.3, 0.4999}) {
            all.push_back(soil(0, 0, 1e4, cut_off, nu));
            all.push_back(soil(30, 0, 1e4, cut_off, nu));
            all.push_back(soil(30, 12, 1e4, cut_off, nu));
            all.push_back(soil(30, 30, 1e4, cut_off, nu));
            all.push_back(soil(55, 55, 2e3, cut_off, nu));
            all.push_back(soil(35, 5, 0.0, cut_off, nu));
        }
    }
    return all;
}

/// The plane's Mohr circle.
struct Circle {
    double centre, radius;
};
Circle circle_of(const Voigt& sigma) {
    return {0.5 * (sigma[0] + sigma[1]), std::hypot(0.5 * (sigma[0] - sigma[1]), sigma[3])};
}

TEST(DruckerPrager, InPlaneStrainFlowItHasTheStrengthAndDilatancyOfMohrCoulomb) {
    for (const double phi_deg : {0.0, 20.0, 35.0, 45.0}) {
        for (const double share : {0.0, 0.4, 1.0}) {
            const DruckerPrager law = soil(phi_deg, share * phi_deg, 15e3, samples::no_cut_off);
            // Shear with the dilatancy of psi, oblique to the axes: the stress becomes constant,
            // and then all strain is plastic.
            const double rate = 1e-4, volume = rate * std::sin(law.psi), turn = 0.7;
            const Voigt d_epsilon{0.5 * volume + 0.5 * rate * std::cos(turn),
                                  0.5 * volume - 0.5 * rate * std::cos(turn), 0.0,
                                  rate * std::sin(turn)};
            const DruckerPragerNumbers numbers = ready(law);
            State state{{-100e3, -100e3, -100e3, 0.0}};
            Update update{};
            for (int n = 0; n < 4000; ++n) {
                update = integrate(numbers, state, d_epsilon);
                state = update.state;
            }
            const Circle circle = circle_of(state.sigma);
            const double mohr_coulomb =
                law.c * std::cos(law.phi) - circle.centre * std::sin(law.phi);
            EXPECT_NEAR(circle.radius / mohr_coulomb, 1.0, 1e-9) << phi_deg << " " << share;
            EXPECT_LT((update.d_epsilon_plastic - d_epsilon).norm(), 1e-9 * rate);
            EXPECT_EQ(update.kind, Return::plane);
        }
    }
}

TEST(DruckerPrager, WithoutFrictionItIsVonMises) {
    const DruckerPrager law = soil(0, 0, 1e4, samples::no_cut_off);
    const State sheared = integrate(law, State{{-5e4, -5e4, -5e4, 0.0}}, {0, 0, 0, 1.0}).state;
    EXPECT_NEAR(sheared.sigma[3], 1e4, 1e-8);
    EXPECT_EQ(mechanics::mean_stress(sheared.sigma), -5e4);
}

TEST(DruckerPrager, EveryReturnEndsOnTheSurfaceAndStaysThere) {
    samples::Draw draw(31);
    std::map<Return, int> reached;
    for (const DruckerPrager& law : soils()) {
        for (int n = 0; n < 200; ++n) {
            const State old{return_to_surface(law, State{draw.voigt(5e4)})};
            const Voigt d_epsilon = draw.strain(1e-2);
            const Update update = integrate(law, old, d_epsilon);
            ++reached[update.kind];
            const double size =
                trial_stress(make_moduli(law.elasticity), old.sigma, d_epsilon).norm() + law.c;
            ASSERT_LT(yield_excess(law, update.state), 1e-12 * size);
            ASSERT_LT((return_to_surface(law, update.state) - update.state.sigma).norm(),
                      1e-11 * size);
            // The stress follows from the elastic strain, and flow dissipates work.
            const Voigt elastic = d_epsilon - update.d_epsilon_plastic;
            const Voigt by_hooke = old.sigma + mechanics::elastic_stress(law.elasticity, elastic);
            ASSERT_LT((by_hooke - update.state.sigma).norm(), 1e-10 * size);
            ASSERT_GE(update.state.sigma.dot(update.d_epsilon_plastic),
                      -1e-9 * size * d_epsilon.norm());
            ASSERT_NEAR(update.state.epsilon_q, mechanics::epsilon_q(update.d_epsilon_plastic),
                        1e-12);
        }
    }
    for (const Return kind : {Return::elastic, Return::plane, Return::apex, Return::tension}) {
        EXPECT_GT(reached[kind], 50) << static_cast<int>(kind);
    }
}

TEST(DruckerPrager, TangentAgreesWithFiniteDifferencesEverywhere) {
    samples::Draw draw(32);
    std::map<Return, int> compared;
    for (const DruckerPrager& law : soils()) {
        const DruckerPragerNumbers numbers = ready(law);
        const double stiffest = law.elasticity.constrained_modulus();
        for (int n = 0; n < 200; ++n) {
            const State old{return_to_surface(law, State{draw.voigt(5e4)})};
            const Voigt d_epsilon = draw.strain(1e-2);
            const double step = 1e-5 * d_epsilon.norm();
            Matrix4 tangent, differences;
            const Update update = integrate(numbers, old, d_epsilon, tangent);
            // 1: elastic, 2: cone, 3: cut-off, 4: its rim
            const auto place = [&](const Voigt& e) {
                const auto r = returned(numbers, strained(numbers, old, e).sigma);
                return !r.outside ? 1 : !r.at_cut_off ? 2 : r.q <= numbers.Q ? 3 : 4;
            };
            bool same = true;
            for (int j = 0; j < 4; ++j) {
                const Voigt h = step * Voigt::Unit(j);
                same = same && place(d_epsilon + 3.0 * h) == place(d_epsilon) &&
                       place(d_epsilon - 3.0 * h) == place(d_epsilon);
                differences.col(j) = (integrate(numbers, old, d_epsilon + h).state.sigma -
                                      integrate(numbers, old, d_epsilon - h).state.sigma) /
                                     (2.0 * step);
            }
            if (!same) continue;
            ++compared[update.kind];
            // As of Mohr-Coulomb's (tangent_test.cpp): h^2 curvature and round-off of the stress.
            ASSERT_LT((tangent - differences).cwiseAbs().maxCoeff() / stiffest, 1e-5)
                << static_cast<int>(update.kind);
        }
    }
    for (const Return kind : {Return::elastic, Return::plane, Return::apex, Return::tension}) {
        EXPECT_GT(compared[kind], 20) << static_cast<int>(kind);
    }
}

}  // namespace
}  // namespace breach::materials::drucker_prager_test
