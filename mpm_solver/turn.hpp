// Rotation of a stress by the spin of one time step.
#pragma once

#include "core/mechanics/tensor.hpp"

namespace breach::mpm {

/// R sigma R^T for a small turn by `angle` [rad], counter-clockwise. The matrix is a rotation to
/// round-off whatever the angle; its tangent is the series of tan to the seventh order: the turn is
/// off by 2e-11 rad at 0.1 rad, by less than round-off below 0.01 rad. No trigonometry in the loop.
inline mechanics::Voigt turned(const mechanics::Voigt& sigma, double angle) {
    const double a2 = angle * angle;
    const double t = angle * (1.0 + a2 * (1.0 / 3.0 + a2 * (2.0 / 15.0 + a2 * (17.0 / 315.0))));
    const double scale = 1.0 / (1.0 + t * t);
    const double cos_2a = (1.0 - t * t) * scale;
    const double sin_2a = 2.0 * t * scale;
    const double centre = 0.5 * (sigma[0] + sigma[1]);
    const double half = 0.5 * (sigma[0] - sigma[1]);
    const double turned_half = half * cos_2a - sigma[3] * sin_2a;
    return {centre + turned_half, centre - turned_half, sigma[2],
            half * sin_2a + sigma[3] * cos_2a};
}

}  // namespace breach::mpm
