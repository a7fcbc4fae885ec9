// State functions of NorSand, sections 1 to 7 of docs/reference/methods/norsand.md, for one point
// or several side by side. Compression positive.
#pragma once

#include <cmath>
#include <numbers>

#include "core/materials/lanes.hpp"
#include "core/materials/norsand/norsand.hpp"

namespace breach::materials::norsand {

inline constexpr double kPa = 1000.0;
inline constexpr double least_f = 0.2;       ///< guard of section 3: least M_i / M
inline constexpr double least_eta_L = 0.05;  ///< guard of section 6, as a share of M_i
inline constexpr double least_H = 10.0;      ///< least hardening modulus, section 6
inline constexpr double no_deviator = 1e-7;  ///< q/p below which a stress has no direction
inline constexpr double on_axis = 3e-9;  ///< cos 3 theta below which a stress counts as triaxial
/// least dilatancy on the triaxial lines, flow rule js; guard of section 5
inline constexpr double least_dilation = -1.2;

/// A symmetric tensor in plane strain: a stress, or a strain with engineering shear.
template <class R>
struct Components {
    R xx, yy, zz, xy;
};

template <class R>
[[gnu::always_inline]] inline Components<R> operator+(const Components<R>& a,
                                                      const Components<R>& b) {
    return {a.xx + b.xx, a.yy + b.yy, a.zz + b.zz, a.xy + b.xy};
}
template <class R>
[[gnu::always_inline]] inline Components<R> operator-(const Components<R>& a,
                                                      const Components<R>& b) {
    return {a.xx - b.xx, a.yy - b.yy, a.zz - b.zz, a.xy - b.xy};
}
template <class R>
[[gnu::always_inline]] inline Components<R> operator*(const std::type_identity_t<R>& k,
                                                      const Components<R>& a) {
    return {k * a.xx, k * a.yy, k * a.zz, k * a.xy};
}
template <class R>
[[gnu::always_inline]] inline Components<R> choose(const MaskOf<R>& mask, const Components<R>& yes,
                                                   const Components<R>& no) {
    using lanes::select;
    return {select(mask, yes.xx, no.xx), select(mask, yes.yy, no.yy), select(mask, yes.zz, no.zz),
            select(mask, yes.xy, no.xy)};
}
template <class R>
[[gnu::always_inline]] inline R trace(const Components<R>& a) {
    return a.xx + a.yy + a.zz;
}
template <class R>
[[gnu::always_inline]] inline R norm(const Components<R>& a) {
    return lanes::root(a.xx * a.xx + a.yy * a.yy + a.zz * a.zz + R(2.0) * a.xy * a.xy);
}
template <class R>
[[gnu::always_inline]] inline Components<R> deviator(const Components<R>& a, const R& mean) {
    return {a.xx - mean, a.yy - mean, a.zz - mean, a.xy};
}
/// q = sqrt(3/2 s:s) of a deviatoric stress.
template <class R>
[[gnu::always_inline]] inline R shear_measure(const Components<R>& s) {
    return lanes::root(R(1.5) * (s.xx * s.xx + s.yy * s.yy + s.zz * s.zz) + R(3.0) * s.xy * s.xy);
}

/// The principal axes and the Lode angle of a deviator, sections 1 and 3.
template <class R>
struct Axes {
    R m_1, m_2, m_3;               ///< principal deviatoric stresses over q, descending
    R cos_2a, sin_2a;              ///< a: angle of the larger in-plane direction
    MaskOf<R> zz_first, zz_third;  ///< zz is the largest or the smallest of the three
    MaskOf<R> isotropic;           ///< no direction
    R sine_3;                      ///< sin 3 theta
    R cosine_3;                    ///< cos 3 theta
    R half_cosine;                 ///< cos(3 theta / 2 + 45 deg)
    R half_sine;
};

/// Principal axes of the deviatoric stress s.
template <class R>
[[gnu::always_inline]] inline Axes<R> axes_of(const Components<R>& s) {
    using namespace lanes;
    const R one(1.0), none(0.0);
    const R size = shear_measure(s);
    Axes<R> a;
    a.isotropic = !(size > none);
    const R inverse = one / select(a.isotropic, one, size);
    const R half = R(0.5) * (s.xx - s.yy);
    const R radius = root(half * half + s.xy * s.xy);
    const auto turned = radius > none;
    const R inverse_radius = one / select(turned, radius, one);
    a.cos_2a = select(turned, half * inverse_radius, one);
    a.sin_2a = select(turned, s.xy * inverse_radius, none);
    const R centre = R(0.5) * (s.xx + s.yy);
    const R major = centre + radius;
    const R minor = centre - radius;
    a.zz_first = s.zz > major;
    a.zz_third = s.zz < minor;
    a.m_1 = larger(major, s.zz) * inverse;
    a.m_2 = larger(minor, smaller(major, s.zz)) * inverse;
    a.m_3 = smaller(minor, s.zz) * inverse;
    a.sine_3 = larger(smaller(R(13.5) * a.m_1 * a.m_2 * a.m_3, one), R(-1.0));
    // From differences, exact where two principal stresses are equal.
    constexpr double factor = 1.5 * std::numbers::sqrt3;
    a.cosine_3 = R(factor) * (a.m_1 - a.m_2) * (a.m_2 - a.m_3) * (a.m_1 - a.m_3);
    const R large = root(R(0.5) * (one + magnitude(a.sine_3)));
    const R small = R(0.5) * a.cosine_3 / large;
    const auto compressive = a.sine_3 >= none;
    a.half_sine = select(compressive, large, small);
    a.half_cosine = select(compressive, small, large);
    return a;
}

/// The tensor with these principal values along the axes, as in-plane components.
template <class R>
[[gnu::always_inline]] inline Components<R> along(const Axes<R>& a, const R& v_1, const R& v_2,
                                                  const R& v_3) {
    using lanes::select;
    const R first = select(a.zz_first, v_2, v_1);
    const R second = select(a.zz_third, v_2, v_3);
    const R third = select(a.zz_first, v_1, select(a.zz_third, v_3, v_2));
    const R centre = R(0.5) * (first + second);
    const R apart = first - second;
    const R turned = R(0.5) * apart * a.cos_2a;
    return {centre + turned, centre - turned, third, apart * a.sin_2a};
}

/// The critical state line at ln(p / 1 kPa), section 2.
template <class R>
struct OnLine {
    R e_c;
    R lambda;  ///< -d e_c / d ln p
};
template <class R>
[[gnu::always_inline]] inline OnLine<R> critical_line(const Ready& law, const R& ln_p) {
    const Parameters& par = law.parameters;
    if (par.semi_log) {
        return {R(par.semi_log->Gamma) - R(par.semi_log->lambda) * ln_p, R(par.semi_log->lambda)};
    }
    const CurvedLine& line = *par.curved;
    const R fall = R(line.C_b) * lanes::exponential(R(line.C_c) * (ln_p - R(law.ln_C_ref)));
    return {R(line.C_a) - fall, R(line.C_c) * fall};
}

/// Section 2 at ln(p / 1 kPa).
template <class R>
[[gnu::always_inline]] inline R shear_modulus(const Ready& law, const R& p, const R& ln_p) {
    const Parameters& par = law.parameters;
    if (par.m == 1.0) return R(par.G_ref / par.p_ref) * p;
    if (par.m == 0.0) return R(par.G_ref);
    return R(par.G_ref) * lanes::exponential(R(par.m) * (ln_p - R(law.ln_p_ref)));
}

/// State at which the formulas are evaluated.
template <class R>
struct Place {
    Components<R> sigma;
    R p_i, e, chi_i;
};

/// Stress ratios and image state, sections 3 and 4.
template <class R>
struct Surface {
    R p, q;
    R p_hat;     ///< max(p, p_min)
    R ln_p_hat;  ///< of p_hat / 1 kPa
    R ln_ratio;  ///< ln(p_i / p)
    R psi_i;
    R lambda_i;
    R f;  ///< M_i / M
    R M, M_i;
    R F;
    Components<R> s;
    Axes<R> axes;
};

/// direction: used if the deviatoric stress vanishes (section 5).
template <class R>
[[gnu::always_inline]] inline Surface<R> surface_at(const Ready& law, const Place<R>& at,
                                                    const Components<R>& direction) {
    using namespace lanes;
    const Parameters& par = law.parameters;
    Surface<R> out;
    out.p = trace(at.sigma) * R(1.0 / 3.0);
    out.s = deviator(at.sigma, out.p);
    out.q = shear_measure(out.s);
    // Far below the floor p_min the values are meaningless, but the logarithms must exist.
    const R p = larger(out.p, R(1e-3 * par.p_min));
    const auto flat = out.q < R(no_deviator) * p;
    out.axes = axes_of(choose(flat, direction, out.s));
    out.p_hat = larger(p, R(par.p_min));
    const R ln_p = logarithm(p * R(1.0 / kPa));
    out.ln_p_hat = larger(ln_p, R(std::log(par.p_min / kPa)));
    const R ln_p_i = logarithm(larger(at.p_i, R(1e-6 * par.p_min)) * R(1.0 / kPa));
    out.ln_ratio = ln_p_i - ln_p;
    const OnLine<R> line = critical_line(law, ln_p_i);
    out.lambda_i = line.lambda;
    out.psi_i = at.e - line.e_c;
    out.M = R(par.M_tc) - R(law.M_fall) * out.axes.half_cosine;
    out.f = larger(R(1.0) - R(par.N / par.M_tc) * at.chi_i * magnitude(out.psi_i), R(least_f));
    out.M_i = out.M * out.f;
    out.F = out.q - out.M_i * p * (R(1.0) + out.ln_ratio);
    return out;
}

/// Plastic flow, gradient and hardening of sections 5 to 7 on the surface.
template <class R>
struct Flow {
    R G, K;
    R D;
    Components<R> r;  ///< deviatoric plastic strain per unit of epsilon_q, engineering shear
    Components<R> n;  ///< deviatoric gradient of F, engineering shear
    R F_e;
    R h;  ///< d p_i per unit of epsilon_q [Pa]
    R A;  ///< denominator of the plastic multiplier, section 7 [Pa]
    MaskOf<R> guarded;
};

/// Section 5, flow rule js: deviatoric ratios of the principal strain rates.
template <class R>
[[gnu::always_inline]] inline Components<R> ratios_of_js(const Ready& law, const Surface<R>& at,
                                                         const R& D) {
    using namespace lanes;
    const R one(1.0);
    const Axes<R>& a = at.axes;
    const R scaled = D / at.M;
    const R D_tc = larger(R(law.parameters.M_tc) * scaled, R(least_dilation));
    const R D_te = larger(R(law.M_te) * scaled, R(least_dilation));
    const R z_tc = (R(2.0) * D_tc - R(3.0)) / (R(2.0) * D_tc + R(6.0));
    const R z_te = (R(2.0) * D_te - R(6.0)) / (R(2.0) * D_te + R(3.0));
    const R z_3 = z_tc + (z_te - z_tc) * a.half_cosine;
    const R z_2 = (a.m_1 * D - one + z_3 * (a.m_3 * D - one)) / (one - a.m_2 * D);
    const R r_1 = one / (a.m_1 + a.m_2 * z_2 + a.m_3 * z_3);
    const R third = D * R(1.0 / 3.0);
    return {r_1 - third, z_2 * r_1 - third, z_3 * r_1 - third, R(0.0)};
}

template <class R>
[[gnu::always_inline]] inline R double_dot(const Components<R>& a, const Components<R>& b) {
    return a.xx * b.xx + a.yy * b.yy + a.zz * b.zz;
}

/// Section 6: d p_i per unit of epsilon_q.
template <class R>
[[gnu::always_inline]] inline R hardening(const Ready& law, const Place<R>& at,
                                          const Surface<R>& surface, const R& K, const R& D,
                                          MaskOf<R>& guarded) {
    using namespace lanes;
    const Parameters& par = law.parameters;
    const R one(1.0);
    const R limit = at.chi_i / (R(par.M_tc) * surface.f);  // chi_i / M_i,tc
    const R fall = limit * surface.psi_i;
    R H(par.H_0);
    if (par.H_psi != 0.0) {
        const R psi = at.e - critical_line(law, surface.ln_p_hat).e_c;
        H = H - R(par.H_psi) * psi;
    }
    H = larger(H, R(least_H));
    const R p = surface.p_hat;
    const R size = at.p_i / p;
    const R p_mx = exponential(-fall);
    R rate = H * (surface.M * R(1.0 / par.M_tc)) * (p_mx - size) / (size * size);
    if (par.S > 0.0) {
        const R stands = one - fall;  // eta_L / M_i
        guarded = guarded | (stands < R(least_eta_L));
        const R eta_L = surface.M_i * larger(stands, R(least_eta_L));
        rate = rate - R(par.S) * (surface.q / (p * eta_L)) * (K / p) * D /
                          (one + limit * surface.lambda_i);
    }
    return at.p_i * rate;
}

template <class R>
[[gnu::always_inline]] inline Flow<R> flow_at(const Ready& law, const Place<R>& at,
                                              const Surface<R>& surface) {
    using namespace lanes;
    const Parameters& par = law.parameters;
    const R none(0.0);
    const Axes<R>& a = surface.axes;
    Flow<R> out;
    out.guarded = surface.f <= R(least_f);
    out.G = shear_modulus(law, surface.p_hat, surface.ln_p_hat);
    out.K = R(law.K_over_G) * out.G;
    out.D = -surface.M_i * surface.ln_ratio;

    // On the surface F_theta / q = -(dM / d theta) / M; 0 on the triaxial lines.
    const R slope = R(1.5 * law.M_fall) * a.half_sine;
    const R pull = select(magnitude(a.cosine_3) < R(on_axis), none, -slope / surface.M);
    // t_k of section 7: cos(60 + theta), -cos theta, cos(60 - theta) from the deviators.
    constexpr double third = 1.0 / std::numbers::sqrt3;
    const R t_1 = R(third) * (a.m_2 - a.m_3) * R(1.5);
    const R t_2 = R(third) * (a.m_3 - a.m_1) * R(1.5);
    const R t_3 = R(third) * (a.m_1 - a.m_2) * R(1.5);
    const Components<R> n{R(1.5) * a.m_1 + pull * t_1, R(1.5) * a.m_2 + pull * t_2,
                          R(1.5) * a.m_3 + pull * t_3, none};
    Components<R> r{R(1.5) * a.m_1, R(1.5) * a.m_2, R(1.5) * a.m_3, none};
    if (par.flow == FlowRule::normal) r = n;
    if (par.flow == FlowRule::js) r = ratios_of_js(law, surface, out.D);
    const Components<R> nothing{none, none, none, none};
    const Components<R> n_k = choose(a.isotropic, nothing, n);
    const Components<R> r_k = choose(a.isotropic, nothing, r);

    out.h = hardening(law, at, surface, out.K, out.D, out.guarded);
    // dM_i / d psi: sign(0) = 0, and 0 while the guard limits f.
    const R side =
        select(surface.psi_i > none, R(1.0), select(surface.psi_i < none, R(-1.0), none));
    const R M_psi =
        select(surface.f <= R(least_f), none, surface.M * R(-par.N / par.M_tc) * at.chi_i * side);
    const R F_M = -surface.p * (R(1.0) + surface.ln_ratio);
    out.F_e = F_M * M_psi;
    const R F_pi = (out.F_e * surface.lambda_i - surface.M_i * surface.p) / at.p_i;
    out.A = out.K * out.D * out.D + R(2.0) * out.G * double_dot(n_k, r_k) - F_pi * out.h;
    out.n = along(a, n_k.xx, n_k.yy, n_k.zz);
    out.r = along(a, r_k.xx, r_k.yy, r_k.zz);
    return out;
}

/// g . d of section 7: the drive of a strain increment d; negative: unloading.
template <class R>
[[gnu::always_inline]] inline R loading(const Flow<R>& flow, const R& e, const Components<R>& d) {
    const R volume = trace(d);
    const R shear = double_dot(flow.n, d) + R(0.5) * flow.n.xy * d.xy;
    return (flow.K * flow.D - (R(1.0) + e) * flow.F_e) * volume + R(2.0) * flow.G * shear;
}

/// D_e applied to a strain with this deviator (engineering shear) and volume.
template <class R>
[[gnu::always_inline]] inline Components<R> elastic(const R& G, const R& K,
                                                    const Components<R>& dev, const R& volume) {
    const R mean = K * volume;
    const R twice = R(2.0) * G;
    return {mean + twice * dev.xx, mean + twice * dev.yy, mean + twice * dev.zz, G * dev.xy};
}

}  // namespace breach::materials::norsand
