#include <gtest/gtest.h>

#include "core/materials/mohr_coulomb/mohr_coulomb.hpp"
#include "tests/unit/materials/samples.hpp"

namespace breach::materials::softening_test {
namespace {

using samples::degree;

MohrCoulomb softening_soil(SofteningDriver driver) {
    MohrCoulomb law = samples::soil(30, 10, 1e4, 0.0);
    law.softening = Softening{0.01, 0.11, 2e3, std::tan(15 * degree), driver};
    return law;
}

TEST(Softening, StrengthFallsLinearlyBetweenStartAndEnd) {
    const MohrCoulomb law = softening_soil(SofteningDriver::plastic);
    EXPECT_EQ(strength(law, 0.0).c, 1e4);
    EXPECT_EQ(strength(law, 0.01).tan_phi, std::tan(law.phi));
    EXPECT_NEAR(strength(law, 0.06).c, 6e3, 1e-9);
    EXPECT_NEAR(strength(law, 0.06).tan_phi, 0.5 * (std::tan(30 * degree) + std::tan(15 * degree)),
                1e-14);
    EXPECT_EQ(strength(law, 0.11).c, 2e3);
    EXPECT_EQ(strength(law, 50.0).tan_phi, std::tan(15 * degree));
}

TEST(Softening, DrivenByPlasticStrainItIgnoresElasticStrain) {
    const MohrCoulomb law = softening_soil(SofteningDriver::plastic);
    const State confined{{-1e5, -1e5, -1e5, 0.0}};
    EXPECT_EQ(integrate(law, confined, {0, 0, 0, 1e-3}).state.epsilon_q, 0.0);
    const Update plastic = integrate(law, confined, {0, 0, 0, 3e-2});
    EXPECT_NEAR(plastic.state.epsilon_q, mechanics::epsilon_q(plastic.d_epsilon_plastic), 1e-16);
}

TEST(Softening, DrivenByTotalStrainItCountsAllOfIt) {
    const MohrCoulomb law = softening_soil(SofteningDriver::total);
    const State confined{{-1e5, -1e5, -1e5, 0.0}, 0.5};
    const Voigt d_epsilon{1e-4, -2e-4, 0.0, 1e-3};
    EXPECT_NEAR(integrate(law, confined, d_epsilon).state.epsilon_q,
                0.5 + mechanics::epsilon_q(d_epsilon), 1e-16);
    const Voigt large{1e-2, -2e-2, 0.0, 1e-1};
    EXPECT_NEAR(integrate(law, confined, large).state.epsilon_q, 0.5 + mechanics::epsilon_q(large),
                1e-15);
}

TEST(Softening, UsesTheStrengthAtTheOldStrain) {
    const MohrCoulomb law = softening_soil(SofteningDriver::plastic);
    const State confined{{-1e5, -1e5, -1e5, 0.0}, 0.06};
    const Update update = integrate(law, confined, {0, 0, 0, 3e-2});
    EXPECT_NEAR(yield_excess(law, State{update.state.sigma, 0.06}), 0.0, 1e-8);
    EXPECT_GT(yield_excess(law, update.state), 0.0);
}

TEST(Softening, LongShearEndsAtTheResidualStrength) {
    MohrCoulomb law = softening_soil(SofteningDriver::plastic);
    law.psi = 0.0;
    State state{{-1e5, -1e5, -1e5, 0.0}};
    for (int n = 0; n < 2000; ++n) state = integrate(law, state, {0, 0, 0, 2e-4}).state;
    law.softening.reset();
    law.c = 2e3;
    law.phi = 15 * degree;
    EXPECT_NEAR(yield_excess(law, state), 0.0, 1e-6);
}

TEST(Softening, NeverDilatesMoreThanItRubs) {
    MohrCoulomb law = samples::soil(30, 30, 1e4, 0.0);
    law.softening = Softening{0.0, 1e-3, 0.0, 0.0, SofteningDriver::plastic};
    const State residual{{-1e5, -1e5, -1e5, 0.0}, 1.0};
    const Update update = integrate(law, residual, {0, 0, 0, 1e-2});
    EXPECT_NEAR(update.d_epsilon_plastic.head<3>().sum(), 0.0, 1e-15);
}

TEST(Softening, CutOffFollowsTheApexDown) {
    MohrCoulomb law = samples::soil(30, 0, 1e4, 1e4);
    law.softening = Softening{0.0, 1e-3, 1e3, std::tan(30 * degree), SofteningDriver::plastic};
    const Update update = integrate(law, State{Voigt::Zero(), 1.0}, {1e-2, 1e-2, 1e-2, 0.0});
    EXPECT_EQ(update.kind, Return::apex);
    EXPECT_NEAR(update.state.sigma[0], 1e3 / std::tan(30 * degree), 1e-8);
}

}  // namespace
}  // namespace breach::materials::softening_test
