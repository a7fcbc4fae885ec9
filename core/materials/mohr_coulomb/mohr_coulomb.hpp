// Mohr-Coulomb with tension cut-off for one point. `ready` computes once what all points share; the
// elastic step is inline.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/materials/mohr_coulomb/principal_return.hpp"
#include "core/materials/traits.hpp"

namespace breach::materials {

/// sigma_1 - sigma_3 + (sigma_1 + sigma_3) sin phi <= 2 c cos phi, tension positive.
struct MohrCoulomb {
    mechanics::Elasticity elasticity;
    double c;               ///< peak cohesion [Pa]
    double phi;             ///< peak friction angle [rad]
    double psi;             ///< dilatancy angle [rad]
    double tension_cutoff;  ///< largest principal stress allowed [Pa], clipped to the cone's apex c
                            ///< / tan(phi)
    std::optional<Softening> softening;
    /// point: in the MPM each point has its own c, phi and residuals (strength/profile.hpp); other
    /// code uses those of the law.
    StrengthOf strength_of = StrengthOf::law;
    double tension_share = 0.0;  ///< tensile over compressive strength, at least: see Tension
};

MohrCoulomb with_strength(MohrCoulomb law, const StrengthOfPoint<double>& strength);

/// Lowers psi to phi where softening brings phi below it.
MohrCoulombNumbers ready(const MohrCoulomb& law);

Strength strength(const MohrCoulomb& law, double epsilon_q);

Traits traits(const MohrCoulomb& law);
std::optional<Strength> limit_strength(const MohrCoulomb& law);
inline const Softening* softening(const MohrCoulomb& law) {
    return law.softening ? &*law.softening : nullptr;
}
inline StrengthEntries strength_entries(MohrCoulomb& law) { return {&law.c, &law.phi, &law.psi}; }
double yield_excess(const MohrCoulomb& law, const State& state);
Voigt return_to_surface(const MohrCoulomb& law, const State& state);
std::optional<LawLanes> for_particles(const MohrCoulomb& law);

Cone cone_at(const MohrCoulombNumbers& law, double epsilon_q);

/// The plastic part of integrate: `trial` lies outside `cone`.
Update return_from(const MohrCoulombNumbers& law, const Cone& cone, const State& trial);

inline bool lies_inside(const Cone& cone, const Voigt& sigma) {
    const double centre = 0.5 * (sigma[0] + sigma[1]);
    const double half = 0.5 * (sigma[0] - sigma[1]);
    const double radius = std::sqrt(half * half + sigma[3] * sigma[3]);
    const double s1 = std::max(centre + radius, sigma[2]);
    const double s3 = std::min(centre - radius, sigma[2]);
    return cone.k * s1 - s3 <= cone.q && s1 <= cone.T;
}

/// New state after the strain increment. Softening is explicit: strength at the old epsilon_q.
inline Update integrate(const MohrCoulombNumbers& law, const State& old, const Voigt& d_epsilon) {
    State trial{trial_stress(law.moduli, old.sigma, d_epsilon), old.epsilon_q};
    if (law.softens == Softens::never) {
        if (lies_inside(law.peak, trial.sigma)) return {trial, Voigt::Zero(), Return::elastic};
        return return_from(law, law.peak, trial);
    }
    const Cone softened = cone_at(law, old.epsilon_q);
    if (law.softens == Softens::with_total_strain) {
        trial.epsilon_q += mechanics::epsilon_q(d_epsilon);
    }
    if (lies_inside(softened, trial.sigma)) return {trial, Voigt::Zero(), Return::elastic};
    return return_from(law, softened, trial);
}

/// The same, and the consistent tangent d sigma / d epsilon [Pa] at fixed strength (not symmetric
/// when psi != phi).
Update integrate(const MohrCoulombNumbers& law, const State& old, const Voigt& d_epsilon,
                 Matrix4& tangent);

/// A single step: resolves the law first.
Update integrate(const MohrCoulomb& law, const State& old, const Voigt& d_epsilon);
Update integrate(const MohrCoulomb& law, const State& old, const Voigt& d_epsilon,
                 Matrix4& tangent);

}  // namespace breach::materials
