#include "core/materials/pm4sand/call.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace breach::materials::pm4sand {

using std::numbers::sqrt2;

Strain<double> inward(const Voigt& d_epsilon) {
    return {-(d_epsilon[0] + d_epsilon[1]),
            {-(d_epsilon[0] - d_epsilon[1]) / sqrt2, -d_epsilon[3] / sqrt2}};
}

double largest_component(const Strain<double>& d) {
    const double xx = 0.5 * (d.v + sqrt2 * d.e.d);
    const double yy = 0.5 * (d.v - sqrt2 * d.e.d);
    return std::max({std::abs(xx), std::abs(yy), std::abs(sqrt2 * d.e.x)});
}

Plane normal(const Ready& law, const Stress& sigma, const Plane& alpha) {
    const double tiny = 1e-10 * law.unit;
    if (std::abs(sigma.p) < tiny) return {0.0, 1.0};
    const Plane across = sigma.s - sigma.p * alpha;
    const double size = norm(across);
    if (size < tiny) return across;
    return (1.0 / size) * across;
}

namespace {

double& part(InPlane& a, int i) { return i == 0 ? a.xx : i == 1 ? a.yy : a.xy; }
double part(const InPlane& a, int i) { return i == 0 ? a.xx : i == 1 ? a.yy : a.xy; }

/// Section 10: updates p_zp.
void remember_pressure(State& state) {
    const double p = std::max(state.p, state.p_min);
    const double product = norm(state.z) * p;
    if (!state.p_zp_unset && !(product > state.zp_max && p > state.p_zp)) return;
    state.zp_max = product;
    state.p_zp = p;
    state.p_zp_unset = false;
}

}  // namespace

void reverse(const Plane& n, State& state) {
    const InPlane old_app = state.alpha_app;
    const InPlane alpha = components(state.alpha);
    state.alpha_prev = deviator(old_app);
    state.alpha_prev_xy = old_app.xy;
    state.alpha_true = state.alpha;
    state.z_in = state.z;
    remember_pressure(state);
    for (int i = 0; i < 3; ++i) {
        if (part(old_app, i) > 0.0) {
            part(state.alpha_min, i) = std::min(part(state.alpha_min, i), part(alpha, i));
        } else {
            part(state.alpha_max, i) = std::max(part(state.alpha_max, i), part(alpha, i));
        }
    }
    // Departs from: the published model, which always uses the history (section 11, as OpenSees).
    if (alpha.xy * state.alpha_prev_xy <= 0.0) {
        state.alpha_app = alpha;
        return;
    }
    const InPlane direction = components(n);
    for (int i = 0; i < 3; ++i) {
        part(state.alpha_app, i) = part(direction, i) > 0.0
                                       ? std::max(0.0, part(state.alpha_min, i))
                                       : std::min(0.0, part(state.alpha_max, i));
    }
}

namespace {

/// Shares at which the elastic path meets the cone: |A + a B|^2 = (m/sqrt2)^2 (p + a p')^2 with p
/// >= 0.
struct Crossings {
    double first;  ///< smallest root in (0, 1], or 1
    double last;   ///< largest root in (0, 1], or 0
};

Crossings crossings(const Ready& law, const Stress& sigma, const Plane& alpha,
                    const Stress& change) {
    const Plane A = sigma.s - sigma.p * alpha;
    const Plane B = change.s - change.p * alpha;
    const double k = law.parameters.m * law.parameters.m / 2.0;
    const double a = dot(B, B) - k * change.p * change.p;
    const double b = dot(A, B) - k * sigma.p * change.p;
    const double c = dot(A, A) - k * sigma.p * sigma.p;
    Crossings found{1.0, 0.0};
    const auto take = [&](double t) {
        if (!(t > 0.0 && t <= 1.0) || sigma.p + t * change.p < 0.0) return;
        found.first = std::min(found.first, t);
        found.last = std::max(found.last, t);
    };
    const double discriminant = b * b - a * c;
    if (discriminant < 0.0) return found;
    const double w = -(b + std::copysign(std::sqrt(discriminant), b));
    if (a != 0.0) take(w / a);
    if (w != 0.0) take(c / w);
    return found;
}

}  // namespace

double last_crossing(const Ready& law, const Stress& sigma, const Plane& alpha,
                     const Stress& change) {
    return crossings(law, sigma, alpha, change).last;
}

double elastic_fraction(const Ready& law, const Stress& sigma, const Plane& alpha,
                        const Stress& change) {
    const double tolerance = 1e-8 * law.unit;
    const Stress trial{sigma.p + change.p, sigma.s + change.s};
    if (yield_function(law, trial, alpha) <= tolerance) return 1.0;
    const double f = yield_function(law, sigma, alpha);
    if (f < -tolerance) return crossings(law, sigma, alpha, change).first;
    if (f > tolerance) return 0.0;
    const Plane n = normal(law, sigma, alpha);
    const double size = std::sqrt(2.0 * change.p * change.p + dot(change.s, change.s));
    if (dot(n, change.s) > -1e-4 * size) return 0.0;
    return crossings(law, sigma, alpha, change).last;
}

void close_call(const Ready& law, const Plane& z, State& state, Counts& counts) {
    const Parameters& par = law.parameters;
    Fixed<double> fixed = fixed_of<double>(state);
    prepare(law, fixed);
    state.M_cur = stress_ratio(state.p, state.s, state.p_min);
    const double M_d =
        par.reconsolidation == Reconsolidation::off
            ? 0.0
            : surfaces(law, std::max(state.p, state.p_min), density(law, state.epsilon_v)).M_d;
    state.G = shear_modulus(law, fixed, state.p, state.M_cur, state.M_b, M_d);
    if (state.M_cur > state.M_b) {
        const Plane r = (state.M_b / (state.M_cur * state.p)) * state.s;
        state.s = state.p * r;
        state.alpha = ((state.M_b - par.m) / state.M_b) * r;
        ++counts.projected;
    }
    state.z_cum += norm(z - state.z) * inverse_sqrt2;
    state.z_peak = std::max(state.z_peak, norm(z) * inverse_sqrt2);
    state.z = z;
}

bool is_finite(const Strain<double>& d) { return std::isfinite(d.v + d.e.d + d.e.x); }

bool is_finite(const State& s) {
    return std::isfinite(s.p + s.s.d + s.s.x + s.alpha.d + s.alpha.x + s.z.d + s.z.x + s.z_cum +
                         s.z_peak + s.G + s.M_b + s.M_cur + s.epsilon_v);
}

}  // namespace breach::materials::pm4sand
