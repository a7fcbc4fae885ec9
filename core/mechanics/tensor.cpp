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

double epsilon_q(const Voigt& epsilon) {
    const Voigt e = deviator(epsilon);
    const double e_e = e[0] * e[0] + e[1] * e[1] + e[2] * e[2] + 0.5 * e[3] * e[3];
    return std::sqrt(2.0 / 3.0 * e_e);
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
