// Secondary parameters, initial state from a stress, and quantities read from a state.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/materials/pm4sand/functions.hpp"
#include "core/materials/pm4sand/pm4sand.hpp"

namespace breach::materials::pm4sand {

using std::numbers::sqrt2;

double default_h_po(double D_R) {
    const double x = D_R - 0.55;
    return 0.40 + 0.25 * x + 4.5 * x * x;
}

Parameters defaults(double D_R, double G_0, double h_po) {
    Parameters law{};
    law.D_R = D_R;
    law.G_0 = G_0;
    law.h_po = h_po;
    law.h_0 = std::max(0.30, (0.25 + D_R) / 2.0);
    law.c_epsilon = 0.5 - 1.5 * (std::clamp(D_R, 0.55, 0.75) - 0.55);
    law.phi_cv = 33.0 * std::numbers::pi / 180.0;
    law.C_DR = std::clamp(5.0 + 25.0 * (D_R - 0.35), 1.0, 10.0);
    law.C_Kaf = std::clamp(5.0 + 220.0 * std::pow(D_R - 0.26, 3), 4.0, 35.0);
    law.F_sed_min = std::min(0.03 * std::exp(2.6 * D_R), 0.99);
    law.p_sedo = law.p_atm / 5.0;
    return law;
}

Ready ready(const Parameters& parameters) {
    const double nu = parameters.nu;
    const double span = parameters.e_max - parameters.e_min;
    const double e_0 = parameters.e_max - span * parameters.D_R;
    return {.parameters = parameters,
            .M_c = 2.0 * std::sin(parameters.phi_cv),
            .K_over_G = 2.0 * (1.0 + nu) / (3.0 * (1.0 - 2.0 * nu)),
            .density_rate = (1.0 + e_0) / span,
            .unit = parameters.p_atm / 101.3};
}

mechanics::Elasticity elastic_stage(const Parameters& parameters, double nu) {
    return {.E = 2.0 * (1.0 + nu) * parameters.G_0 * parameters.p_atm, .nu = nu};
}

double void_ratio(const Ready& law, const State& state) {
    const Parameters& par = law.parameters;
    return par.e_max - (par.e_max - par.e_min) * density(law, state.epsilon_v);
}

Voigt stress(const Ready& law, const State& state) {
    const double xx = state.p + state.s.d / sqrt2 + state.sigma_b.xx;
    const double yy = state.p - state.s.d / sqrt2 + state.sigma_b.yy;
    const double xy = state.s.x / sqrt2 + state.sigma_b.xy;
    return {-xx, -yy, -law.parameters.nu * (xx + yy), -xy};
}

Counts& Counts::operator+=(const Counts& other) {
    evaluations += other.evaluations;
    sub_steps += other.sub_steps;
    rejected += other.rejected;
    forced += other.forced;
    projected += other.projected;
    softened += other.softened;
    stalled += other.stalled;
    return *this;
}

namespace {

/// A_do from the initial surfaces. For xi_R -> 0 it tends to 1.25 n_b / ((n_b + n_d) cos phi_cv),
/// used for all looser states; 1.24 with default surfaces.
double initial_dilatancy(const Ready& law, const Surfaces<double>& at) {
    const Parameters& par = law.parameters;
    if (at.xi < 0.0) {
        if (at.M_b > 2.0) return 1.5;
        return 2.5 * (std::asin(at.M_b / 2.0) - std::asin(law.M_c / 2.0)) / (at.M_b - at.M_d);
    }
    const Parameters usual = defaults(par.D_R, par.G_0, par.h_po);
    if (par.n_b == usual.n_b && par.n_d == usual.n_d && par.phi_cv == usual.phi_cv) return 1.24;
    return 1.25 * par.n_b / ((par.n_b + par.n_d) * std::cos(par.phi_cv));
}

/// Moves the stress inside the surfaces; the rest becomes sigma_b.
void place_stress(const Ready& law, double p_0, const Plane& s_0, State& state) {
    const double m = law.parameters.m;
    if (p_0 < state.p_min) {
        state.p = state.p_min;
        state.s = {0.0, 0.0};
        state.alpha = {0.0, 0.0};
    } else {
        state.p = p_0;
        state.s = s_0;
        state.alpha = (1.0 / p_0) * s_0;
    }
    const Surfaces<double> at = surfaces(law, state.p, law.parameters.D_R);
    const double M_cut = std::max(at.M_b, at.M_d);
    const double M_ini = sqrt2 * norm(state.s) / state.p;
    if (M_ini > M_cut) {
        const Plane r = (M_cut / (M_ini * state.p)) * state.s;
        state.s = state.p * r;
        state.alpha = ((M_cut - m) / M_cut) * r;
    }
    state.sigma_b = {p_0 - state.p + (s_0.d - state.s.d) / sqrt2,
                     p_0 - state.p - (s_0.d - state.s.d) / sqrt2, (s_0.x - state.s.x) / sqrt2};
}

/// alpha, moved onto the bound if it is outside.
Plane within_bound(const Ready& law, const State& state) {
    const double bound = (state.M_b - law.parameters.m) / sqrt2;
    const double reached = norm(state.alpha);
    return reached > bound ? (bound / reached) * state.alpha : state.alpha;
}

}  // namespace

State initialise(const Ready& law, const Voigt& sigma, double epsilon_v, Scheme scheme) {
    const Parameters& par = law.parameters;
    const double p_0 = -0.5 * (sigma[0] + sigma[1]);
    const Plane s_0{-(sigma[0] - sigma[1]) / sqrt2, -sqrt2 * sigma[3]};

    State state{};
    state.p_min = std::max(p_0, par.p_atm) / 200.0;
    state.p_min2 = 10.0 * state.p_min;
    place_stress(law, p_0, s_0, state);

    const Surfaces<double> at = surfaces(law, state.p, par.D_R);
    state.z_max = par.z_max.value_or(std::min(0.7 * std::exp(-6.1 * at.xi), 20.0));
    state.A_do = par.A_do.value_or(initial_dilatancy(law, at));
    state.M_b = at.M_b;
    state.alpha_true = scheme == Scheme::reference ? state.alpha : within_bound(law, state);
    state.alpha_min = state.alpha_max = components(state.alpha_true);
    state.z_peak = state.z_max / 1e5;
    state.p_zp = state.p / 100.0;
    state.p_zp_unset = true;
    state.epsilon_v = epsilon_v;
    state.M_cur = stress_ratio(state.p, state.s, state.p_min);
    Fixed<double> fixed = fixed_of<double>(state);
    prepare(law, fixed);
    state.G = shear_modulus(law, fixed, state.p, state.M_cur, at.M_b, at.M_d);
    return state;
}

}  // namespace breach::materials::pm4sand
