#include "core/mechanics/tensor.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

namespace breach::mechanics {
namespace {

constexpr double pi = 3.14159265358979323846;
const Voigt some_stress{-4e3, 1e3, -2.5e3, 1.7e3};

Matrix2 in_plane(const Voigt& sigma) {
    Matrix2 m;
    m << sigma[0], sigma[3], sigma[3], sigma[1];
    return m;
}

Matrix2 rotation(double angle) {
    Matrix2 R;
    R << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
    return R;
}

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

TEST(Tensor, RotatedStressIsRSigmaRTransposed) {
    for (const double angle : {0.3, -1.2, 2.9, pi}) {
        const Matrix2 R = rotation(angle);
        const Matrix2 expected = R * in_plane(some_stress) * R.transpose();
        const Voigt turned = rotated_stress(some_stress, angle);
        EXPECT_LT((in_plane(turned) - expected).cwiseAbs().maxCoeff(), 1e-11);
        EXPECT_EQ(turned[2], some_stress[2]);
    }
}

TEST(Tensor, PrincipalStressesAreTheEigenvaluesAndGoBack) {
    const Principal p = principal(some_stress);
    EXPECT_NEAR(p.major + p.minor, -3e3, 1e-11);
    EXPECT_NEAR(p.major * p.minor, in_plane(some_stress).determinant(), 1e-6);
    EXPECT_GE(p.major, p.minor);
    EXPECT_LT((from_principal(p) - some_stress).cwiseAbs().maxCoeff(), 1e-11);
    // along its own axis the stress has no shear
    const double a = 0.5 * std::atan2(p.sin_2a, p.cos_2a);
    const Voigt own = rotated_stress(some_stress, -a);
    EXPECT_NEAR(own[0], p.major, 1e-11);
    EXPECT_NEAR(own[3], 0.0, 1e-11);
}

TEST(Tensor, IsotropicStressHasDefiniteAxes) {
    const Principal p = principal({5.0, 5.0, 1.0, 0.0});
    EXPECT_EQ(p.cos_2a, 1.0);
    EXPECT_EQ(p.sin_2a, 0.0);
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
