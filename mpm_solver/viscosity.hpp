// Newtonian part of the stress, beside what the law says: tau = 2 eta dev D. Elastic soil feels it
// too, where it only damps waves (relaxation time eta / G).
#pragma once

#include "mpm_solver/points.hpp"

namespace breach::mpm {

/// Components of a stress that make forces in the plane [Pa].
struct InPlane {
    double xx, yy, xy;
};

inline InPlane viscous_stress(const Points& points, std::size_t p, double eta) {
    const double mean = (points.Lxx[p] + points.Lyy[p]) / 3.0;
    return {2.0 * eta * (points.Lxx[p] - mean), 2.0 * eta * (points.Lyy[p] - mean),
            eta * (points.Lxy[p] + points.Lyx[p])};
}

/// Dissipation over dt in the zone, sum of V 2 eta dev D : dev D dt [J].
double viscous_work(const Points& points, const Zone& zone, double dt);

/// What viscosity adds to the wave speed in the Courant step, 16 eta / (3 rho h) [m/s]: a lagged
/// damping of eigenvalue (4/3) eta 8 / (rho h^2) is stable up to half its period.
double viscous_speed(const Zone& zone, double h);

}  // namespace breach::mpm
