#include "core/mechanics/tensor.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace breach::mechanics {
namespace {

const Voigt some_stress{-4e3, 1e3, -2.5e3, 1.7e3};

TEST(Tensor, MeanAndDeviatorMakeTheStress) {
    EXPECT_NEAR(mean_stress(some_stress), -5.5e3 / 3.0, 1e-12);
    const Voigt s = deviator(some_stress);
    EXPECT_NEAR(s[0] + s[1] + s[2], 0.0, 1e-12);
    EXPECT_EQ(s[3], some_stress[3]);
}

TEST(Tensor, SimpleShearHasEquivalentStrainGammaOverRootThree) {
    EXPECT_NEAR(epsilon_q({0, 0, 0, 0.3}), 0.3 / std::sqrt(3.0), 1e-16);
    EXPECT_NEAR(epsilon_q({0.1, 0.1, 0.1, 0.0}), 0.0, 1e-16);
    // triaxial: epsilon_q = 2/3 (epsilon_a - epsilon_r)
    EXPECT_NEAR(epsilon_q({0.3, -0.1, -0.1, 0.0}), 2.0 / 3.0 * 0.4, 1e-16);
}

TEST(JacobianRatio, SeesAreaAtTheCentreAndShearInTheCorners) {
    Eigen::Matrix<double, 2, 4> square;
    square << 0, 1, 1, 0, 0, 0, 1, 1;
    const Eigen::Matrix<double, 2, 4> larger = 1.5 * square;
    EXPECT_NEAR(jacobian_ratio(larger, square).centre, 2.25, 1e-15);
    EXPECT_NEAR(jacobian_ratio(larger, square).least, 2.25, 1e-15);
    Eigen::Matrix<double, 2, 4> dart = square;
    dart.col(2) = Vec2(0.3, 0.3);  // pushed through the diagonal
    EXPECT_GT(jacobian_ratio(dart, square).centre, 0.0);
    EXPECT_LT(jacobian_ratio(dart, square).least, 0.0);
}

}  // namespace
}  // namespace breach::mechanics
