#include "core/mechanics/tensor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace breach::mechanics {

double mean_stress(const Voigt& sigma) { return (sigma[0] + sigma[1] + sigma[2]) / 3.0; }

Voigt deviator(const Voigt& sigma) {
    const double m = mean_stress(sigma);
    return {sigma[0] - m, sigma[1] - m, sigma[2] - m, sigma[3]};
}

Voigt deviatoric_strain(const Voigt& epsilon) { return deviator(epsilon); }

double epsilon_q(const Voigt& epsilon) {
    const Voigt e = deviatoric_strain(epsilon);
    const double e_e = e[0] * e[0] + e[1] * e[1] + e[2] * e[2] + 0.5 * e[3] * e[3];
    return std::sqrt(2.0 / 3.0 * e_e);
}

double double_dot(const Voigt& sigma, const Voigt& epsilon) { return sigma.dot(epsilon); }

Voigt rotated_stress(const Voigt& sigma, double angle) {
    const double c2 = std::cos(2.0 * angle);
    const double s2 = std::sin(2.0 * angle);
    const double centre = 0.5 * (sigma[0] + sigma[1]);
    const double half = 0.5 * (sigma[0] - sigma[1]);
    const double turned_half = half * c2 - sigma[3] * s2;
    return {centre + turned_half, centre - turned_half, sigma[2], half * s2 + sigma[3] * c2};
}

Principal principal(const Voigt& sigma) {
    const double centre = 0.5 * (sigma[0] + sigma[1]);
    const double half = 0.5 * (sigma[0] - sigma[1]);
    const double radius = std::hypot(half, sigma[3]);
    if (radius == 0.0) return {centre, centre, sigma[2], 1.0, 0.0};
    return {centre + radius, centre - radius, sigma[2], half / radius, sigma[3] / radius};
}

Voigt from_principal(const Principal& p) {
    const double centre = 0.5 * (p.major + p.minor);
    const double radius = 0.5 * (p.major - p.minor);
    return {centre + radius * p.cos_2a, centre - radius * p.cos_2a, p.normal, radius * p.sin_2a};
}

namespace {

double corner_jacobian(const Eigen::Matrix<double, 2, 4>& x, int k) {
    const Vec2 forward = x.col((k + 1) % 4) - x.col(k);
    const Vec2 backward = x.col((k + 3) % 4) - x.col(k);
    return forward.x() * backward.y() - forward.y() * backward.x();
}

double twice_area(const Eigen::Matrix<double, 2, 4>& x) {
    const Vec2 d1 = x.col(2) - x.col(0);
    const Vec2 d2 = x.col(3) - x.col(1);
    return d1.x() * d2.y() - d1.y() * d2.x();
}

}  // namespace

JacobianRatio jacobian_ratio(const Eigen::Matrix<double, 2, 4>& current,
                             const Eigen::Matrix<double, 2, 4>& reference) {
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 4; ++k) {
        least = std::min(least, corner_jacobian(current, k) / corner_jacobian(reference, k));
    }
    return {twice_area(current) / twice_area(reference), least};
}

}  // namespace breach::mechanics
