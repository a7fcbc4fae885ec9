// A turned specimen, for tests that a law has no preferred direction.
#pragma once

#include <cmath>

#include "core/mechanics/tensor.hpp"

namespace breach {

/// R sigma R^T for a rotation by `angle` [rad], counter-clockwise.
inline mechanics::Voigt rotated_stress(const mechanics::Voigt& sigma, double angle) {
    const double c2 = std::cos(2.0 * angle), s2 = std::sin(2.0 * angle);
    const double centre = 0.5 * (sigma[0] + sigma[1]), half = 0.5 * (sigma[0] - sigma[1]);
    const double turned_half = half * c2 - sigma[3] * s2;
    return {centre + turned_half, centre - turned_half, sigma[2], half * s2 + sigma[3] * c2};
}

}  // namespace breach
