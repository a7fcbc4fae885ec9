// State functions of PM4Sand, sections 4 to 9 of docs/reference/methods/pm4sand.md, for one point
// or several side by side. Compression positive.
#pragma once

#include <numbers>

#include "core/materials/lanes.hpp"
#include "core/materials/pm4sand/pm4sand.hpp"

namespace breach::materials::pm4sand {

inline constexpr double inverse_sqrt2 = 1.0 / std::numbers::sqrt2;

template <class R>
[[gnu::always_inline]] inline Deviator<R> operator+(const Deviator<R>& a, const Deviator<R>& b) {
    return {a.d + b.d, a.x + b.x};
}
template <class R>
[[gnu::always_inline]] inline Deviator<R> operator-(const Deviator<R>& a, const Deviator<R>& b) {
    return {a.d - b.d, a.x - b.x};
}
template <class R>
[[gnu::always_inline]] inline Deviator<R> operator*(const std::type_identity_t<R>& k,
                                                    const Deviator<R>& a) {
    return {k * a.d, k * a.x};
}
template <class R>
[[gnu::always_inline]] inline R dot(const Deviator<R>& a, const Deviator<R>& b) {
    return a.d * b.d + a.x * b.x;
}
template <class R>
[[gnu::always_inline]] inline R norm(const Deviator<R>& a) {
    return lanes::root(dot(a, a));
}
template <class R>
[[gnu::always_inline]] inline Deviator<R> choose(const MaskOf<R>& mask, const Deviator<R>& yes,
                                                 const Deviator<R>& no) {
    return {lanes::select(mask, yes.d, no.d), lanes::select(mask, yes.x, no.x)};
}

inline InPlane components(const Plane& a) {
    return {a.d * inverse_sqrt2, -a.d * inverse_sqrt2, a.x * inverse_sqrt2};
}
/// Deviatoric part; enough for any projection on a deviatoric direction.
inline Plane deviator(const InPlane& a) {
    return {(a.xx - a.yy) * inverse_sqrt2, std::numbers::sqrt2 * a.xy};
}

/// A strain increment, compression positive; the model's e:n is dot(e, n).
template <class R>
struct Strain {
    R v;            ///< volumetric
    Deviator<R> e;  ///< ((xx - yy) / sqrt2, gamma / sqrt2)
};

/// Current relative density D_R'.
template <class R>
[[gnu::always_inline]] inline R density(const Ready& law, const R& epsilon_v) {
    return R(law.parameters.D_R) + R(law.density_rate) * epsilon_v;
}

/// M_cur = q / max(p, p_min).
template <class R>
[[gnu::always_inline]] inline R stress_ratio(const R& p, const Deviator<R>& s, const R& p_min) {
    return R(std::numbers::sqrt2) * norm(s) / lanes::larger(p, p_min);
}

template <class R>
struct Surfaces {
    R xi;   ///< relative state parameter index xi_R
    R M_b;  ///< bounding ratio
    R M_d;  ///< dilatancy ratio
};

/// Section 4. p_hat = max(p, p_min); D = current relative density.
template <class R>
[[gnu::always_inline]] inline Surfaces<R> surfaces(const Ready& law, const R& p_hat, const R& D) {
    using namespace lanes;
    const Parameters& par = law.parameters;
    // Above p_atm exp(Q) / 100 Bolton's line has no meaning; the floor keeps the ratio finite.
    const R depth = larger(R(par.Q) - logarithm(p_hat * R(100.0 / par.p_atm)), R(0.01));
    const R xi = R(par.R) / depth - D;
    const auto dense = xi <= R(0.0);
    // Unlimited expansion (an inverted element) would bring M_b inside the cone, and every
    // projection would then move alpha to the opposite side.
    const R M_b = larger(
        R(law.M_c) * exponential(xi * select(dense, R(-par.n_b), R(-0.25 * par.n_b))), R(par.m));
    const R M_d = R(law.M_c) * exponential(xi * select(dense, R(par.n_d), R(4.0 * par.n_d)));
    return {xi, M_b, M_d};
}

/// Quantities that are constant while rates are evaluated (updated once per call or sub-step), and
/// the factors of sections 5 to 7 that depend on them alone.
template <class R>
struct Fixed {
    Deviator<R> alpha_app, alpha_true, alpha_prev, z_in;
    R z_cum, z_peak, p_zp;
    R A_do, z_max, p_min, p_min2;

    R C_zpk1;     ///< z_peak / (z_cum + z_max / 5)
    R slowing;    ///< C_KP (z_peak / z_max) sqrt(1 - C_zpk2)
    R C_dz;       ///< section 7.2
    R damage;     ///< modulus factor (1 + z_cum/z_max) / (1 + C_GD z_cum/z_max)
    R inverse_z;  ///< 1 / z_max
    R growth;     ///< c_z / (1 + <z_cum / (2 z_max) - 1>)
};

template <class R>
[[gnu::always_inline]] inline void prepare(const Ready& law, Fixed<R>& f) {
    using namespace lanes;
    constexpr double C_KP = 2.0;
    const R one(1.0);
    f.inverse_z = one / f.z_max;
    const R cum = f.z_cum * f.inverse_z;
    const R peak = f.z_peak * f.inverse_z;
    f.C_zpk1 = peak / (cum + R(0.2));
    const R C_zpk2 = smaller(peak / (cum + R(0.01)), R(1.0 - 1e-10));
    const R C_rot2 = one - C_zpk2;
    f.slowing = R(C_KP) * peak * root(C_rot2);
    f.C_dz = larger((one - C_rot2 * R(std::numbers::sqrt2) * peak) / (one + C_rot2 * cum),
                    one / (one + R(0.5) * f.z_max));
    f.damage = (one + cum) / (one + R(law.parameters.C_GD) * cum);
    f.growth = R(law.parameters.c_z) / (one + positive(R(0.5) * cum - one));
}

template <class R>
Fixed<R> fixed_of(const State& state);

/// Section 5; with section 16 if reconsolidation is on.
template <class R>
[[gnu::always_inline]] inline R shear_modulus(const Ready& law, const Fixed<R>& f, const R& p,
                                              const R& M_cur, const R& M_b, const R& M_d) {
    using namespace lanes;
    const Parameters& par = law.parameters;
    const R p_hat = larger(p, f.p_min);
    const R ratio = M_cur / M_b;
    const R ratio2 = ratio * ratio;
    const R C_SR = R(1.0) - R(0.5) * smaller(R(1.0), ratio2 * ratio2);
    const R G = R(par.G_0 * par.p_atm) * root(p_hat * R(1.0 / par.p_atm)) * C_SR * f.damage;
    if (par.reconsolidation == Reconsolidation::off) return G;
    const R left = root(root(positive(R(1.0) - M_cur / M_d)));
    const R p_sed = R(par.p_sedo) * f.z_cum / (f.z_cum + f.z_max) * left;
    const R tiny(1e-10 * law.unit);
    const R F_sed = R(par.F_sed_min) + R(1.0 - par.F_sed_min) * p_hat * R(0.05) / (p_sed + tiny);
    return G * smaller(F_sed, R(1.0));
}

/// Plastic modulus, dilatancy and the quantities that the rates need.
template <class R>
struct Flow {
    R B;  ///< b:n
    R h;
    R K_p;
    R D;            ///< > 0: contraction
    R X_d;          ///< (alpha^d - alpha):n
    Deviator<R> b;  ///< alpha^b - alpha
};

/// State at which rates are evaluated.
template <class R>
struct Point {
    R p;
    Deviator<R> alpha, n, z;
    R G, M_cur;
};

/// Section 6 without the clip. nearest: least distance of the back-stress ratio from the bound [-].
template <class R>
[[gnu::always_inline]] inline void plastic_modulus(const Ready& law, const Fixed<R>& f,
                                                   const Point<R>& at, const R& p_hat, const R& M_b,
                                                   double nearest, Flow<R>& flow) {
    using namespace lanes;
    const Parameters& par = law.parameters;
    const R one(1.0);
    const R bound = (M_b - R(par.m)) * R(inverse_sqrt2);
    flow.b = bound * at.n - at.alpha;
    flow.B = dot(flow.b, at.n);
    const R x_app = positive(dot(at.alpha - f.alpha_app, at.n));
    const R x_true = positive(dot(at.alpha - f.alpha_true, at.n));
    const R C_g1(par.h_0 / 200.0);
    const R relief = positive(f.p_zp - p_hat);
    const R x25 = R(2.5) * x_true;
    const R C_KA =
        one + R(par.C_Kaf) * relief * f.C_zpk1 / ((one + x25 * x25) * (relief + f.p_min));
    const R size = larger(magnitude(flow.B), R(nearest));
    const R resistance = p_hat * (exponential(x_app) - one + C_g1) * root(size) *
                         (one + f.slowing * positive(flow.B));
    const auto reloading = dot(at.alpha - f.alpha_prev, at.n) <= R(0.0);
    const R C_rev = select(reloading, (x_app + C_g1) / (x_true + C_g1), one);
    flow.h = select(size < R(1e-10), R(1e10), R(1.5 * par.h_0) * at.G * C_KA * C_rev / resistance);
    flow.K_p = R(2.0 / 3.0) * p_hat * flow.h * flow.B;
}

/// Section 7.1, with its M_d, X_R, C_zin1 and zm.
template <class R>
struct Dilating {
    R M_b, M_d, X_R, C_zin1, zm;
};

template <class R>
[[gnu::always_inline]] inline R dilation(const Ready& law, const Fixed<R>& f, const Point<R>& at,
                                         const R& p_hat, const Dilating<R>& in, const R& X_d) {
    using namespace lanes;
    const Parameters& par = law.parameters;
    const R one(1.0);
    const R pressure = select(f.p_zp > R(0.0), R(2.5) * p_hat / f.p_zp, R(0.0));
    const R pressure2 = pressure * pressure;
    const R low = f.p_min2 / p_hat;
    const R w = in.C_zin1 * (f.z_cum - f.z_peak) * f.inverse_z * R(1.0 / 3.0);
    const R C_zin2 = (one + w) / (one + R(3.0) * w);
    const R open = one - in.zm * R(inverse_sqrt2) / f.z_peak;
    const R c(par.c_epsilon * par.c_epsilon);
    // C_pzp and C_pmin, as their reciprocals.
    const R memory = f.z_cum * f.z_cum * f.inverse_z * open * open * open * c * in.C_zin1 /
                     ((one + pressure2 * pressure2 * pressure) * (one + low * low));
    const R A_d = f.A_do * C_zin2 / (memory + one);
    const R D_1 = A_d * X_d;
    const R D_2 = A_d * in.zm * R(inverse_sqrt2) * f.inverse_z * in.X_R * R(1.0 / par.C_DR);
    const R margin = positive(in.M_b - at.M_cur);
    const R D = select(D_1 <= D_2, D_1, D_1 + (D_2 - D_1) * margin / (margin + R(0.01)));
    const R twice = R(2.0) * f.p_min;
    const R forced = R(-3.5) * f.A_do * positive(in.M_b - in.M_d) * (twice - p_hat) / f.p_min;
    return select(p_hat <= twice, smaller(D, forced), D);
}

/// Section 7.2.
template <class R>
[[gnu::always_inline]] inline R contraction(const Ready& law, const Fixed<R>& f, const Point<R>& at,
                                            const R& p_hat, const R& xi, const R& zn,
                                            const R& X_d) {
    using namespace lanes;
    constexpr double C_D = 0.16;
    const R one(1.0);
    const R loose = positive(R(0.5) - xi);
    const R h_p = R(law.parameters.h_po) * exponential(R(-0.7) + R(7.0) * loose * loose);
    const R along = positive(zn);
    const R A_dc = f.A_do * (one + along) / (h_p * f.C_dz);
    const R travel =
        dot(at.alpha - f.alpha_app, at.n) + R(std::numbers::sqrt2) * along * f.inverse_z;
    const R D = smaller(A_dc * travel * travel, R(1.5) * f.A_do) * X_d / (X_d + R(C_D));
    const R C_pmin2 = (p_hat - R(2.0) * f.p_min) / (R(16.0) * f.p_min);
    return D * smaller(positive(C_pmin2), one);
}

/// Sections 6 and 7 at a point with known surfaces. nearest: see plastic_modulus; 0: as OpenSees.
template <class R>
[[gnu::always_inline]] inline Flow<R> flow(const Ready& law, const Fixed<R>& f, const Point<R>& at,
                                           const Surfaces<R>& surface, double nearest = 0.0) {
    using namespace lanes;
    const Parameters& par = law.parameters;
    const R one(1.0);
    const R p_hat = larger(at.p, f.p_min);
    Flow<R> out;
    plastic_modulus(law, f, at, p_hat, surface.M_b, nearest, out);

    const R zn = dot(at.z, at.n);
    const R zm = positive(-zn);
    const R moved = magnitude(dot(f.z_in, at.n) - zn) * f.inverse_z;
    R C_zin1(0.0);
    if (any(moved > R(0.0))) C_zin1 = positive(one - exponential(R(-2.0) * moved));
    const R C_rot1 = larger(one, one + R(std::numbers::sqrt2) * zm * f.inverse_z * (one - C_zin1));
    const R an = dot(at.alpha, at.n);
    out.X_d = (surface.M_d - R(par.m)) * R(inverse_sqrt2) - an;
    const R X_R = (surface.M_d / C_rot1 - R(par.m)) * R(inverse_sqrt2) - an;

    const auto contracting = X_R > R(0.0);
    out.D = R(0.0);
    if (any(contracting)) {
        out.D = contraction(law, f, at, p_hat, surface.xi, zn, out.X_d);
        out.K_p = select(contracting, positive(out.K_p), out.K_p);
    }
    if (any(!contracting)) {
        const Dilating<R> in{surface.M_b, surface.M_d, X_R, C_zin1, zm};
        out.D = select(contracting, out.D, dilation(law, f, at, p_hat, in, out.X_d));
    }
    return out;
}

/// Section 9: z' for the multiplier L; zero unless the point dilates.
template <class R>
[[gnu::always_inline]] inline Deviator<R> fabric_rate(const Fixed<R>& f, const Point<R>& at,
                                                      const Flow<R>& flow, const R& L) {
    using namespace lanes;
    const MaskOf<R> grows = (flow.X_d < R(0.0)) & (flow.D < R(0.0)) & (L > R(0.0));
    const R rate = select(grows, -f.growth * L, R(0.0));
    return rate * (f.z_max * at.n + at.z);
}

template <>
inline Fixed<double> fixed_of(const State& s) {
    Fixed<double> f{};
    f.alpha_app = deviator(s.alpha_app);
    f.alpha_true = s.alpha_true;
    f.alpha_prev = s.alpha_prev;
    f.z_in = s.z_in;
    f.z_cum = s.z_cum;
    f.z_peak = s.z_peak;
    f.p_zp = s.p_zp;
    f.A_do = s.A_do;
    f.z_max = s.z_max;
    f.p_min = s.p_min;
    f.p_min2 = s.p_min2;
    return f;
}

}  // namespace breach::materials::pm4sand
