#include "core/mechanics/elasticity.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace breach::mechanics {
namespace {

constexpr Elasticity soil{2e7, 0.3};
const Voigt some_strain{1e-3, -4e-4, 2e-4, 6e-4};

TEST(Elasticity, UniaxialStressGivesYoungAndPoisson) {
    const Voigt e = elastic_strain(soil, {1e4, 0, 0, 0});
    EXPECT_NEAR(e[0], 1e4 / soil.E, 1e-18);
    EXPECT_NEAR(e[1], -soil.nu * e[0], 1e-18);
    EXPECT_NEAR(e[2], -soil.nu * e[0], 1e-18);
}

TEST(Elasticity, StrainAndStressAreInverses) {
    for (const double nu : {0.0, 0.3, 0.4999}) {
        const Elasticity each{2e7, nu};
        const Voigt back = elastic_strain(each, elastic_stress(each, some_strain));
        EXPECT_LT((back - some_strain).cwiseAbs().maxCoeff(), 1e-15);
    }
}

TEST(Elasticity, StiffnessMatrixIsTheSameMap) {
    const Voigt by_matrix = elastic_stiffness(soil) * some_strain;
    EXPECT_LT((by_matrix - elastic_stress(soil, some_strain)).cwiseAbs().maxCoeff(), 1e-10);
}

TEST(Elasticity, ConstrainedCompressionHasTheConstrainedModulus) {
    EXPECT_NEAR(elastic_stress(soil, {1e-3, 0, 0, 0})[0], 1e-3 * soil.constrained_modulus(), 1e-9);
    EXPECT_NEAR(soil.wave_speed(1800.0), std::sqrt(soil.constrained_modulus() / 1800.0), 1e-12);
}

/// The shear modulus stays down to nu = 0.2; below, both moduli decrease.
TEST(Elasticity, IsSlowedByItsBulkModulusFirst) {
    const Elasticity undrained{72e6, 0.495};
    for (const double limit : {1000.0, 400.0}) {
        const Elasticity slow = slowed(undrained, 1865.0, limit);
        EXPECT_NEAR(slow.wave_speed(1865.0), limit, 1e-9 * limit);
        EXPECT_NEAR(slow.shear_modulus(), undrained.shear_modulus(), 1.0);
        EXPECT_GT(slow.nu, 0.2);
    }
    const Elasticity slowest = slowed(undrained, 1865.0, 50.0);
    EXPECT_NEAR(slowest.wave_speed(1865.0), 50.0, 1e-9);
    EXPECT_NEAR(slowest.nu, 0.2, 1e-12);
    EXPECT_EQ(slowed(undrained, 1865.0, 2000.0).E, undrained.E);
}

TEST(Elasticity, EnergyIsHalfTheWork) {
    const Voigt sigma = elastic_stress(soil, some_strain);
    EXPECT_NEAR(elastic_energy_density(soil, sigma), 0.5 * sigma.dot(some_strain), 1e-12);
}

}  // namespace
}  // namespace breach::mechanics
