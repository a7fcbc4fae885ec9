#include <gtest/gtest.h>

#include "core/materials/law.hpp"

namespace breach::materials::linear_elastic_test {
namespace {

constexpr mechanics::Elasticity rock{5e7, 0.25};

TEST(LinearElastic, AddsHookesStressAndNoPlasticStrain) {
    const LinearElastic law{rock};
    const State old{{-1e3, -2e3, -1.5e3, 400.0}, 0.02};
    const Voigt d_epsilon{1e-4, -3e-4, 0.0, 2e-4};
    // lambda = 20 MPa, G = 20 MPa; tr = -2e-4
    const Update update = integrate(law, old, d_epsilon);
    EXPECT_NEAR(update.state.sigma[0], -1e3 - 4e3 + 4e3, 1e-9);
    EXPECT_NEAR(update.state.sigma[1], -2e3 - 4e3 - 12e3, 1e-9);
    EXPECT_NEAR(update.state.sigma[2], -1.5e3 - 4e3, 1e-9);
    EXPECT_NEAR(update.state.sigma[3], 400.0 + 4e3, 1e-9);
    EXPECT_EQ(update.d_epsilon_plastic, Voigt::Zero());
    EXPECT_EQ(update.state.epsilon_q, 0.02);
    EXPECT_EQ(update.kind, Return::elastic);
}

TEST(LinearElastic, TangentIsTheElasticStiffness) {
    Matrix4 tangent;
    integrate(LinearElastic{rock}, State{Voigt::Zero()}, Voigt::Zero(), tangent);
    EXPECT_EQ(tangent, mechanics::elastic_stiffness(rock));
}

TEST(Law, GivesItsElasticityForEveryLaw) {
    EXPECT_EQ(elasticity(Law{LinearElastic{rock}}).E, 5e7);
    EXPECT_EQ(elasticity(Law{MohrCoulomb{rock, 0, 0, 0, 0, std::nullopt}}).nu, 0.25);
}

}  // namespace
}  // namespace breach::materials::linear_elastic_test
