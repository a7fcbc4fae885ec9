#include "core/geometry/quad.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

namespace breach::geometry {
namespace {

Corners kite() {
    Corners x;
    x << 0.0, 3.0, 2.0, -0.5,  //
        0.0, 0.5, 2.5, 1.0;
    return x;
}

TEST(Quad, ShapeFunctionsAreOneAtTheirCornerAndSumToOne) {
    const Vec2 corner[4] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    for (int i = 0; i < 4; ++i)
        for (int k = 0; k < 4; ++k) EXPECT_EQ(shape_functions(corner[k])[i], i == k ? 1.0 : 0.0);
    EXPECT_NEAR(shape_functions({0.3, -0.7}).sum(), 1.0, 1e-15);
    EXPECT_NEAR(shape_gradients({0.3, -0.7}).rowwise().sum().norm(), 0.0, 1e-15);
}

TEST(Quad, ItsJacobianIsLinearBetweenTheCorners) {
    const Eigen::Vector4d J = corner_jacobians(kite());
    for (const Vec2& xi : {Vec2(0.0, 0.0), Vec2(0.4, -0.9), Vec2(-1.0, 0.2)})
        EXPECT_NEAR(jacobian(kite(), xi).determinant(), J.dot(shape_functions(xi)), 1e-14);
}

TEST(Quad, TheSumOfItsCornerJacobiansIsItsArea) {
    const Corners x = kite();
    double twice_area = 0.0;  // shoelace
    for (int i = 0; i < 4; ++i)
        twice_area += x(0, i) * x(1, (i + 1) % 4) - x(0, (i + 1) % 4) * x(1, i);
    EXPECT_NEAR(corner_jacobians(x).sum(), 0.5 * twice_area, 1e-14);
}

// Gauss-Legendre with n points is exact to degree 2n - 1 and not beyond.
TEST(GaussRule, IsExactToItsDegree) {
    for (int n = 1; n <= 8; ++n) {
        const GaussRule rule = gauss_legendre(n);
        for (int degree = 0; degree <= 2 * n; ++degree) {
            double sum = 0.0;
            for (int i = 0; i < n; ++i) sum += rule.weight[i] * std::pow(rule.position[i], degree);
            const double exact = degree % 2 == 0 ? 2.0 / (degree + 1) : 0.0;
            if (degree < 2 * n)
                EXPECT_NEAR(sum, exact, 1e-14) << n << " points, degree " << degree;
            else
                EXPECT_GT(std::abs(sum - exact), 1e-6);
        }
    }
}

TEST(ShiftedRule, IsExactToOneDegreeLessAndItsPointsMove) {
    for (int n = 1; n <= 8; ++n)
        for (const double shift : {-0.9, -0.3, 0.5, 0.9}) {
            const GaussRule rule = shifted_rule(n, shift);
            const GaussRule plain = gauss_legendre(n);
            for (int degree = 0; degree <= 2 * n - 2; ++degree) {
                double sum = 0.0;
                for (int i = 0; i < n; ++i)
                    sum += rule.weight[i] * std::pow(rule.position[i], degree);
                EXPECT_NEAR(sum, degree % 2 == 0 ? 2.0 / (degree + 1) : 0.0, 1e-13)
                    << n << " points, degree " << degree;
            }
            for (int i = 0; i < n; ++i) {
                EXPECT_GT(shift * (rule.position[i] - plain.position[i]), 0.0);
                EXPECT_LT(std::abs(rule.position[i]), 1.0);
                EXPECT_GT(rule.weight[i], 0.0);
            }
        }
}

// Radau's two points: -1/3 and the border, with weights 3/2 and 1/2.
TEST(ShiftedRule, EndsAtRadaus) {
    const GaussRule rule = shifted_rule(2, 1.0 - 1e-12);
    EXPECT_NEAR(rule.position[0], -1.0 / 3.0, 1e-9);
    EXPECT_NEAR(rule.position[1], 1.0, 1e-9);
    EXPECT_NEAR(rule.weight[0], 1.5, 1e-9);
    EXPECT_NEAR(rule.weight[1], 0.5, 1e-9);
}

TEST(ShiftedRule, WithoutAShiftIsGausssToTheLastBit) {
    EXPECT_EQ(shifted_rule(3, 0.0).position, gauss_legendre(3).position);
    EXPECT_EQ(shifted_rule(3, 0.0).weight, gauss_legendre(3).weight);
}

TEST(EvenRule, IsExactToDegreeThreeForAnyNumberAndNearlyEven) {
    for (int n = 2; n <= 11; ++n)
        for (const double shift : {0.0, 0.6}) {
            const GaussRule rule = even_rule(n, shift);
            ASSERT_EQ(rule.position.size(), static_cast<std::size_t>(n));
            for (int degree = 0; degree <= (shift == 0.0 ? 3 : 2); ++degree) {
                double sum = 0.0;
                for (int i = 0; i < n; ++i)
                    sum += rule.weight[i] * std::pow(rule.position[i], degree);
                EXPECT_NEAR(sum, degree % 2 == 0 ? 2.0 / (degree + 1) : 0.0, 1e-13)
                    << n << " points, degree " << degree;
            }
            for (int i = 1; i < n && shift == 0.0; ++i) {
                EXPECT_GT(rule.position[i] - rule.position[i - 1], 1.5 / n);
                EXPECT_LT(rule.position[i] - rule.position[i - 1], 2.4 / n);
            }
        }
    for (const double w : even_rule(14, 0.0).weight) EXPECT_DOUBLE_EQ(w, 1.0 / 7.0);
}

TEST(Quad, ClosedFormIntegralsAgreeWithQuadrature) {
    const GaussRule rule = gauss_legendre(4);
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j)
            for (int k = 0; k < 4; ++k) {
                double two = 0.0;
                double three = 0.0;
                for (int a = 0; a < 4; ++a)
                    for (int b = 0; b < 4; ++b) {
                        const Eigen::Vector4d N =
                            shape_functions({rule.position[a], rule.position[b]});
                        two += rule.weight[a] * rule.weight[b] * N[i] * N[k];
                        three += rule.weight[a] * rule.weight[b] * N[i] * N[j] * N[k];
                    }
                EXPECT_NEAR(integral(i, k), two, 1e-15);
                EXPECT_NEAR(integral(i, j, k), three, 1e-15);
            }
}

}  // namespace
}  // namespace breach::geometry
