// Drucker-Prager with a cut-off of mean tension for one point: elastic, perfectly plastic, the cone
// fitted to c, phi and psi of Mohr-Coulomb in plane strain. The surface has no edges.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/materials/drucker_prager/lanes.hpp"
#include "core/materials/traits.hpp"

namespace breach::materials {

/// Has Mohr-Coulomb's strength and dilatancy in plastic flow in plane strain; in triaxial
/// compression it is stronger, in extension weaker.
struct DruckerPrager {
    mechanics::Elasticity elasticity;
    double c;               ///< cohesion [Pa]
    double phi;             ///< friction angle [rad]
    double psi;             ///< dilatancy angle [rad], <= phi
    double tension_cutoff;  ///< largest mean stress allowed [Pa], clipped to the cone's apex
};

/// Fit in plastic flow in plane strain with constant elastic strains: s_zz = -2 beta q, so the
/// in-plane radius is r = q sqrt(1 - 3 beta^2) about the centre p + beta q. r = c cos(phi) - centre
/// sin(phi) and dilatancy sin(psi) give (Drucker & Prager 1952 for psi = phi)
///     beta = sin(psi) / sqrt(9 + 3 sin^2(psi)),     s = sqrt(1 - 3 beta^2),
///     alpha = sin(phi) / (3 (s + beta sin(phi))),   k = c cos(phi) (1 - 3 alpha beta) / s.
inline DruckerPragerNumbers ready(const DruckerPrager& law) {
    const double sin_phi = std::sin(law.phi);
    const double sin_psi = std::sin(law.psi);
    const double beta = sin_psi / std::sqrt(9.0 + 3.0 * sin_psi * sin_psi);
    const double s = std::sqrt(1.0 - 3.0 * beta * beta);
    const double alpha = sin_phi / (3.0 * (s + beta * sin_phi));
    const double k = law.c * std::cos(law.phi) * (1.0 - 3.0 * alpha * beta) / s;
    const double apex = alpha > 0.0 ? k / (3.0 * alpha) : law.tension_cutoff;
    const double T = std::min(law.tension_cutoff, apex);
    const bool ends_at_apex = alpha > 0.0 && apex <= law.tension_cutoff;
    const double rim = alpha > 0.0 ? k - 3.0 * alpha * T : k;
    return {make_moduli(law.elasticity), alpha, beta, k, T, ends_at_apex ? 0.0 : rim};
}

inline Update updated(const DruckerPragerNumbers& law, const ConeReturnOf<double>& r,
                      const State& trial) {
    if (!r.outside) return {trial, Voigt::Zero(), Return::elastic};
    const auto& [G, K, lambda] = law.moduli;
    const Voigt one(1.0, 1.0, 1.0, 0.0);
    const Voigt s = trial.sigma - r.p * one;
    const double left = deviator_left(r);
    const Voigt engineering(1.0, 1.0, 1.0, 2.0);
    const Voigt flow =
        (1.0 - left) / (2.0 * G) * s.cwiseProduct(engineering) + (r.p - r.p_new) / (3.0 * K) * one;
    const Return kind = !r.at_cut_off  ? Return::plane
                        : law.Q == 0.0 ? Return::apex
                                       : Return::tension;
    // sqrt(2/3 e:e) of e = (1 - left) s / 2G
    const double d_epsilon_q = (r.q - r.q_new) / (std::sqrt(3.0) * G);
    return {{left * s + r.p_new * one, trial.epsilon_q + d_epsilon_q}, flow, kind};
}

inline State strained(const DruckerPragerNumbers& law, const State& old, const Voigt& d_epsilon) {
    return {trial_stress(law.moduli, old.sigma, d_epsilon), old.epsilon_q};
}
inline ConeReturnOf<double> returned(const DruckerPragerNumbers& law, const Voigt& trial) {
    return return_to_cone<double>(law, {trial[0], trial[1], trial[2], trial[3]});
}

inline Update integrate(const DruckerPragerNumbers& law, const State& old, const Voigt& d_epsilon) {
    const State trial = strained(law, old, d_epsilon);
    return updated(law, returned(law, trial.sigma), trial);
}

/// The same, and the consistent tangent d sigma / d epsilon [Pa] (symmetric when psi = phi):
///     K 1 1' + rho 2G I_dev + (1 - rho) G m m' - (3 K beta 1 + G m) (G m + 3 K alpha 1)' / D
/// on the cone, with m = s / q of the trial, rho the share of the deviator that is left and
/// D = G + 9 K alpha beta; on the cut-off 2G I_dev, on its rim rho (2G I_dev - G m m').
inline Update integrate(const DruckerPragerNumbers& law, const State& old, const Voigt& d_epsilon,
                        Matrix4& tangent) {
    const State trial = strained(law, old, d_epsilon);
    const ConeReturnOf<double> r = returned(law, trial.sigma);
    tangent = elastic_stiffness(law.moduli);
    if (!r.outside) return updated(law, r, trial);
    const auto& [G, K, lambda] = law.moduli;
    const Voigt one(1.0, 1.0, 1.0, 0.0);
    const Matrix4 two_G_dev = tangent - K * one * one.transpose();
    const double rho = deviator_left(r);
    const Voigt m = r.q > 0.0 ? Voigt((trial.sigma - r.p * one) / r.q) : Voigt::Zero();
    const Matrix4 G_m_m = G * m * m.transpose();
    if (!r.at_cut_off) {
        const double D = G + 9.0 * K * law.alpha * law.beta;
        tangent = K * one * one.transpose() + rho * two_G_dev + (1.0 - rho) * G_m_m -
                  (3.0 * K * law.beta * one + G * m) *
                      (G * m + 3.0 * K * law.alpha * one).transpose() / D;
    } else if (r.q <= law.Q) {
        tangent = two_G_dev;
    } else {
        tangent = rho * (two_G_dev - G_m_m);
    }
    return updated(law, r, trial);
}

/// A single step: resolves the law first.
inline Update integrate(const DruckerPrager& law, const State& old, const Voigt& d_epsilon) {
    return integrate(ready(law), old, d_epsilon);
}

inline Traits traits(const DruckerPrager& law) {
    return {.type = "drucker_prager",
            .name = "Drucker-Prager",
            .yields = true,
            .opens = true,
            .frictional = law.phi > 0.0,
            .c_and_phi = true,
            .symmetric_tangent = law.psi == law.phi,
            .tells_plastic_strain = true};
}
/// Strength in plane strain, for which the cone is fitted.
inline std::optional<Strength> limit_strength(const DruckerPrager& law) {
    return Strength{law.c, std::tan(law.phi)};
}
inline const Softening* softening(const DruckerPrager&) { return nullptr; }
inline StrengthEntries strength_entries(DruckerPrager& law) { return {&law.c, &law.phi, &law.psi}; }
inline double yield_excess(const DruckerPrager& law, const State& state) {
    const DruckerPragerNumbers cone = ready(law);
    const ConeReturnOf<double> r = returned(cone, state.sigma);
    return std::max(r.q + 3.0 * cone.alpha * r.p - cone.k, r.p - cone.T);
}
inline Voigt return_to_surface(const DruckerPrager& law, const State& state) {
    return integrate(law, state, Voigt::Zero()).state.sigma;
}
inline std::optional<LawLanes> for_particles(const DruckerPrager& law) {
    return DruckerPragerLanes{ready(law)};
}

}  // namespace breach::materials
