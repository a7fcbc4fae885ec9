// NorSand (norsand.hpp) in the interface of a law. A point's memory is a norsand::State
// (memory.hpp), which determines its undrained strength (state_parameter.hpp).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/materials/norsand/fields.hpp"
#include "core/materials/norsand/undrained.hpp"
#include "core/materials/traits.hpp"

namespace breach::materials {

struct NorSand {
    using Memory = norsand::State;
    using Update = norsand::Update;
    static constexpr bool has_state_parameter = true;

    /// of the elastic stages before norsand::initialise: G = G_ref
    mechanics::Elasticity elasticity;
    norsand::Ready ready;  ///< with the material's S; stages may set another (with_S)
    norsand::Options options;
    /// initial state parameter [-]; give exactly one of psi_0, e_0, psi_0_profile
    std::optional<double> psi_0;
    std::optional<double> e_0;             ///< initial void ratio [-]
    double R = 1.0;                        ///< overconsolidation [-]
    std::optional<Table> psi_0_profile{};  ///< psi_0 along depth or elevation
};

inline const NorSand& ready(const NorSand& law) { return law; }

/// sigma'_h / sigma'_v of level ground after elastic stages [-].
inline double K_0(const NorSand& law) { return law.elasticity.nu / (1.0 - law.elasticity.nu); }
/// p' of level ground under sigma'_v0 [Pa].
inline double level_ground_p(const NorSand& law, double sigma_v0) {
    return (1.0 + 2.0 * K_0(law)) / 3.0 * sigma_v0;
}
/// The state parameter of level ground consolidated under sigma'_v0 [-].
inline double psi_at(const NorSand& law, const Place& place) {
    if (law.psi_0_profile) return law.psi_0_profile->at(place);
    if (!law.e_0) return law.psi_0.value_or(0.0);
    const double p = level_ground_p(law, place.sigma_v0);
    return *law.e_0 -
           norsand::critical_void_ratio(law.ready, std::max(p, law.ready.parameters.p_min));
}

/// The FEM uses the tangent of the elastic predictor, which is symmetric.
inline Traits traits(const NorSand&) {
    return {.type = "norsand",
            .name = "NorSand",
            .yields = true,
            .opens = false,
            .frictional = true,
            .c_and_phi = false,
            .symmetric_tangent = true,
            .tells_plastic_strain = false};
}
/// Sine of the friction angle of triaxial compression at the stress ratio eta = q/p.
inline double sine_at(double eta) { return 3.0 * eta / (6.0 + eta); }
/// At critical state: friction only.
inline std::optional<Strength> limit_strength(const NorSand& law) {
    return Strength{0.0, std::tan(std::asin(sine_at(law.ready.parameters.M_tc)))};
}
inline const Softening* softening(const NorSand&) { return nullptr; }
inline StrengthEntries strength_entries(NorSand&) { return {}; }
/// The surface depends on the point's memory: from a stress alone nothing can be said.
inline double yield_excess(const NorSand&, const State&) {
    return -std::numeric_limits<double>::infinity();
}
inline Voigt return_to_surface(const NorSand&, const State& state) { return state.sigma; }
inline std::optional<LawLanes> for_particles(const NorSand&) { return std::nullopt; }

inline double least_mean_stress(const NorSand& law) { return law.ready.parameters.p_min; }
inline double mean_stress(const NorSand& law, const Voigt& sigma) {
    return std::max(-(sigma[0] + sigma[1] + sigma[2]) / 3.0, least_mean_stress(law));
}
template <class PlaceOf>
NorSand at_place(const NorSand& law, const PlaceOf& place_of) {
    if (!law.psi_0_profile) return law;
    return {.elasticity = law.elasticity,
            .ready = law.ready,
            .options = law.options,
            .psi_0 = law.psi_0_profile->at(place_of()),
            .e_0 = {},
            .R = law.R};
}
/// How the law reads the initial stress of a point.
inline norsand::Beginning beginning(const NorSand& law, const Voigt& sigma) {
    const double p = mean_stress(law, sigma);
    const double e_0 =
        law.e_0 ? *law.e_0 : law.psi_0.value_or(0.0) + critical_void_ratio(law.ready, p);
    return norsand::initialise(law.ready, sigma, e_0, law.R);
}
/// Ignores the volumetric strain of elastic stages: psi_0 applies to the initial stress.
inline norsand::State first_memory(const NorSand& law, const Voigt& sigma, double) {
    return beginning(law, sigma).state;
}
inline Voigt stress(const NorSand&, const norsand::State& memory) {
    return norsand::stress(memory);
}
/// Halves a strain increment that the law could not integrate, and the halves again, until the
/// evaluations are used up. Ignores strain of round-off size.
inline norsand::Update integrate_in_parts(const NorSand& law, const norsand::State& old,
                                          const Voigt& d_epsilon, int cuts_left,
                                          int& evaluations_left) {
    constexpr double round_off = 1e-14;  // strain
    if (d_epsilon.cwiseAbs().maxCoeff() <= round_off) return {old, norsand::Outcome::done, {}};
    norsand::Update first = norsand::integrate(law.ready, old, d_epsilon, law.options);
    evaluations_left -= first.counts.evaluations;
    if (first.outcome != norsand::Outcome::unresolved || cuts_left == 0 || evaluations_left < 0)
        return first;
    first = integrate_in_parts(law, old, 0.5 * d_epsilon, cuts_left - 1, evaluations_left);
    if (first.outcome != norsand::Outcome::done) return {old, first.outcome, first.counts};
    norsand::Update second =
        integrate_in_parts(law, first.state, 0.5 * d_epsilon, cuts_left - 1, evaluations_left);
    second.counts += first.counts;
    if (second.outcome != norsand::Outcome::done) second.state = old;
    return second;
}
inline void integrate(const NorSand& law, std::span<const norsand::State> old,
                      std::span<const Voigt> d_epsilon, std::span<norsand::Update> updates) {
    norsand::integrate(law.ready, old, d_epsilon, law.options, updates);
    constexpr int most_cuts = 10, most_calls = 50;  // cost of most_calls calls at their limit
    for (std::size_t i = 0; i < updates.size(); ++i) {
        if (updates[i].outcome != norsand::Outcome::unresolved) continue;
        int evaluations_left = most_calls * law.options.most_evaluations;
        updates[i] = integrate_in_parts(law, old[i], d_epsilon[i], most_cuts, evaluations_left);
    }
}
inline Matrix4 elastic_tangent(const NorSand& law, const norsand::State& memory) {
    return norsand::elastic_tangent(law.ready, memory);
}
inline double shear_modulus(const NorSand& law, const norsand::State& memory) {
    return norsand::read(law.ready, memory).G;
}
/// For the largest stress ratio that `initialise` allows.
inline double friction(const NorSand& law, const norsand::State& memory) {
    const norsand::Reading reading = norsand::read(law.ready, memory);
    return sine_at(0.98 * std::max(std::min(reading.eta_L, reading.M_i), 0.05));
}
/// 0: a stress outside the limit is reduced to it, nothing is kept separately.
inline double stress_outside(const NorSand&, const norsand::State&) { return 0.0; }
inline bool has_fallen(const NorSand&, const norsand::State& memory) { return memory.has_fallen; }

inline Instability instability(const NorSand& law, const norsand::State& state) {
    const norsand::Reading at = norsand::read(law.ready, state);
    const double ratio = at.eta_L > 0.0 ? at.q / (at.p * at.eta_L) : 0.0;
    Instability out{at.psi, ratio, false};
    const double half = 0.5 * (state.yy - state.xx);  // tension positive, like the strain
    if (std::hypot(half, state.xy) <= 1e-7 * at.p) return out;
    // Response of the tangent to in-plane strain along the deviator at constant volume.
    const Voigt along(half, -half, 0.0, -2.0 * state.xy);
    const Voigt s(at.p - state.xx, at.p - state.yy, at.p - state.zz, -state.xy);
    const Voigt rate = plastic_tangent(law.ready, state, along) * along;
    out.past_peak = s[0] * rate[0] + s[1] * rate[1] + s[2] * rate[2] + 2.0 * s[3] * rate[3] < 0.0;
    return out;
}
inline std::vector<UndrainedStrength> undrained_strengths(const NorSand& law,
                                                          std::span<const norsand::State> memories,
                                                          std::span<const double> bounds) {
    return norsand::undrained_strengths(law.ready, memories, bounds);
}
inline std::vector<UndrainedStrength> undrained_strengths(const NorSand& law,
                                                          std::span<const Voigt> sigma,
                                                          std::span<const double> psi,
                                                          std::span<const double> u) {
    std::vector<norsand::State> states;
    std::vector<double> bounds;
    for (std::size_t i = 0; i < sigma.size(); ++i) {
        const double p = mean_stress(law, sigma[i]);
        const double e = psi[i] + norsand::critical_void_ratio(law.ready, p);
        states.push_back(norsand::initialise(law.ready, sigma[i], e, 1.0).state);
        bounds.push_back(p + std::max(u[i], 0.0));
    }
    return norsand::undrained_strengths(law.ready, states, bounds);
}
/// Interpolates a table that is computed once.
UndrainedByPlace undrained_by_place(const NorSand& law, OnPath part);
inline void set_s(NorSand& law, double S) {
    norsand::Parameters parameters = law.ready.parameters;
    parameters.S = S;
    law.ready = norsand::ready(parameters);
}

}  // namespace breach::materials
