// Mohr-Coulomb made ready for a loop over points: everything that does not change from point to
// point is computed once, and the elastic step is inline.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/materials/law.hpp"
#include "core/materials/mohr_coulomb/principal_return.hpp"

namespace breach::materials {

/// A law prepared for a zone. psi is lowered to phi where softening brings phi below it.
struct ReadyMohrCoulomb {
    MohrCoulomb law;
    Moduli moduli;
    double tan_phi;
    double tan_psi;
    Cone peak;
};

ReadyMohrCoulomb ready(const MohrCoulomb& law);
inline LinearElastic ready(const LinearElastic& law) { return law; }

/// The cone in force at this epsilon_q.
Cone cone_at(const ReadyMohrCoulomb& law, double epsilon_q);

/// In-plane principal values of a stress with the direction of the larger one (as
/// mechanics::Principal).
struct PlanePrincipal {
    double centre;
    double radius;
    double normal;
    double cos_2a;
    double sin_2a;
};

/// The plastic half of integrate: `trial` lies outside `cone`.
Update return_from(const ReadyMohrCoulomb& law, const Cone& cone, const State& trial);

inline bool lies_inside(const Cone& cone, const Voigt& sigma) {
    const double centre = 0.5 * (sigma[0] + sigma[1]);
    const double half = 0.5 * (sigma[0] - sigma[1]);
    const double radius = std::sqrt(half * half + sigma[3] * sigma[3]);
    const double s1 = std::max(centre + radius, sigma[2]);
    const double s3 = std::min(centre - radius, sigma[2]);
    return cone.k * s1 - s3 <= cone.q && s1 <= cone.T;
}

inline Voigt trial_stress(const Moduli& moduli, const Voigt& sigma, const Voigt& d_epsilon) {
    const double volumetric = moduli.lambda * (d_epsilon[0] + d_epsilon[1] + d_epsilon[2]);
    return {sigma[0] + volumetric + 2.0 * moduli.G * d_epsilon[0],
            sigma[1] + volumetric + 2.0 * moduli.G * d_epsilon[1],
            sigma[2] + volumetric + 2.0 * moduli.G * d_epsilon[2],
            sigma[3] + moduli.G * d_epsilon[3]};
}

inline Update integrate(const ReadyMohrCoulomb& law, const State& old, const Voigt& d_epsilon) {
    const Cone& cone = law.peak;
    State trial{trial_stress(law.moduli, old.sigma, d_epsilon), old.epsilon_q};
    if (!law.law.softening) {
        if (lies_inside(cone, trial.sigma)) return {trial, Voigt::Zero(), Return::elastic};
        return return_from(law, cone, trial);
    }
    const Cone softened = cone_at(law, old.epsilon_q);
    if (law.law.softening->driver == SofteningDriver::total) {
        trial.epsilon_q += mechanics::epsilon_q(d_epsilon);
    }
    if (lies_inside(softened, trial.sigma)) return {trial, Voigt::Zero(), Return::elastic};
    return return_from(law, softened, trial);
}

/// The same with the consistent tangent [Pa] at fixed strength.
Update integrate(const ReadyMohrCoulomb& law, const State& old, const Voigt& d_epsilon,
                 Matrix4& tangent);

}  // namespace breach::materials
