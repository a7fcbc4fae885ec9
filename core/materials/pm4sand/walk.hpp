// The adaptive scheme of section 13.6 for one point (double) or several side by side (Lanes): a
// linearly implicit W-method (ROS34PW2, Rang & Angermann 2005) in (p, alpha, theta, z). theta is
// the angle of the plastic direction n, and s = p alpha + (m p / sqrt2) n, so that the stress
// cannot drift off the yield cone. Integrates the plastic part of a call.
#pragma once

#include <array>

#include "core/materials/pm4sand/functions.hpp"

namespace breach::materials::pm4sand {

/// Unknowns y or their derivatives. The back-stress ratio has components along and across the
/// sub-step's first normal n_0, in which the stiff part of the system is block-diagonal.
template <class R>
struct Unknowns {
    R p;
    R along, across;  ///< alpha = along n_0 + across t_0
    R theta;          ///< angle from n_0
    Deviator<R> z;

    [[gnu::always_inline]] Unknowns plus(double a, const Unknowns& k) const {
        return {p + R(a) * k.p, along + R(a) * k.along, across + R(a) * k.across,
                theta + R(a) * k.theta, z + R(a) * k.z};
    }
    [[gnu::always_inline]] Unknowns times(double a) const {
        return {R(a) * p, R(a) * along, R(a) * across, R(a) * theta, R(a) * z};
    }
};

/// The stiff entries of the Jacobian; a W-method may treat all others explicitly.
template <class R>
struct Stiffness {
    R theta_theta, theta_across, across_theta, across_across, along_along;

    [[gnu::always_inline]] void multiply(const Unknowns<R>& k, const R& scale,
                                         Unknowns<R>& sum) const {
        sum.theta = sum.theta + scale * (theta_theta * k.theta + theta_across * k.across);
        sum.across = sum.across + scale * (across_theta * k.theta + across_across * k.across);
        sum.along = sum.along + scale * along_along * k.along;
    }
    /// k := (1 - scale J)^-1 k.
    [[gnu::always_inline]] void solve(const R& scale, Unknowns<R>& k) const {
        const R one(1.0);
        const R a = one - scale * theta_theta, b = -scale * theta_across;
        const R c = -scale * across_theta, d = one - scale * across_across;
        const R inverse = one / (a * d - b * c);
        const R theta = (d * k.theta - b * k.across) * inverse;
        k.across = (a * k.across - c * k.theta) * inverse;
        k.theta = theta;
        k.along = k.along / (one - scale * along_along);
    }
};

/// Reversal where (alpha - alpha_in^true):n falls below this: 1 % of the cone's radius below zero.
/// With zero, alpha that shrinks with its bounding surface right after a reversal would reverse
/// again.
inline double reversed_below(const Ready& law) { return -0.01 * law.parameters.m; }

/// Least distance of the back-stress ratio from its bound: 1 % of the cone's radius. On the bound h
/// is infinite; alpha would turn with n, and the stress slide along the bound as if it were
/// elastic.
inline double nearest_to_bound(const Ready& law) { return 0.01 * law.parameters.m; }

template <class R>
class Walk {
  public:
    Walk(const Ready& law, const Options& options) : law_(law), options_(options) {}

    // Present state.
    R p, time, step;  ///< time: share of the call's plastic strain that is done; step: next share
    Deviator<R> alpha, n, z;
    R epsilon_v;  ///< volumetric strain at time 0
    Strain<R> d;  ///< the call's plastic strain
    R size;       ///< its magnitude
    Fixed<R> fixed;
    // Results of the last sub-step.
    R G;
    R proposed;  ///< next step by the error control
    R evaluations, sub_steps, rejected, forced, projected, softened, stalled;
    std::array<R*, 7> counts() {
        return {&evaluations, &sub_steps, &rejected, &forced, &projected, &softened, &stalled};
    }

    /// Evaluates surfaces, modulus and rates at the present state; returns the lanes that unload or
    /// reverse.
    [[gnu::always_inline]] MaskOf<R> begin(const MaskOf<R>& busy);
    /// Tries one sub-step and accepts or rejects it lane by lane. Returns the lanes that cannot
    /// continue.
    [[gnu::always_inline]] MaskOf<R> advance(const MaskOf<R>& moving);

  private:
    struct Evaluation {
        Unknowns<R> rate;
        R L, h, mu, B, K_p, p, a_t, a_n, pull;  ///< pull = (2 G / p) n.e
        MaskOf<R> unloads;
    };
    [[gnu::always_inline]] Surfaces<R> surfaces_at(const R& p_now, const R& time_now) const;
    [[gnu::always_inline]] Evaluation evaluate(const Unknowns<R>& y, const Surfaces<R>& surface,
                                               const Fixed<R>& memory);
    [[gnu::always_inline]] Unknowns<R> stage(const Unknowns<R>& y, const R& time_now);
    [[gnu::always_inline]] void project(const Surfaces<R>& surface, const MaskOf<R>& busy);
    [[gnu::always_inline]] Deviator<R> t_0() const { return {-n.x, n.d}; }
    /// Smallest sub-step [share of the call]. Where the right-hand side jumps (low pressure,
    /// repeated projection, sign of B) no step meets the tolerance: each forced sub-step and each
    /// projection raises the limit by 5 %, up to the sub-step of the reference scheme.
    [[gnu::always_inline]] R least_step() const {
        using namespace lanes;
        const R first(options_.least_sub_step);
        const R jumps = forced + projected;
        if (!any(jumps > R(0.0))) return first / size;
        return smaller(first * exponential(R(0.05) * jumps), R(1e-5)) / size;
    }
    [[gnu::always_inline]] R floor() const { return R(0.2) * fixed.p_min; }

    const Ready& law_;
    const Options& options_;
    R counted_;  ///< 1 in lanes whose evaluations are counted
    Unknowns<R> y_0_, f_0_;
    Stiffness<R> J_;
};

template <class R>
inline Surfaces<R> Walk<R>::surfaces_at(const R& p_now, const R& time_now) const {
    return surfaces(law_, lanes::larger(p_now, fixed.p_min),
                    density(law_, epsilon_v + time_now * d.v));
}

template <class R>
inline typename Walk<R>::Evaluation Walk<R>::evaluate(const Unknowns<R>& y,
                                                      const Surfaces<R>& surface,
                                                      const Fixed<R>& memory) {
    using namespace lanes;
    const double m = law_.parameters.m;
    const R p_now = larger(y.p, floor());
    const auto turned = turn(y.theta);
    const Deviator<R> normal_now = turned.cosine * n + turned.sine * t_0();
    const Deviator<R> tangent{-normal_now.x, normal_now.d};
    const Deviator<R> alpha_now = y.along * n + y.across * t_0();
    const Deviator<R> r = alpha_now + R(m * inverse_sqrt2) * normal_now;
    const R M_cur = stress_ratio(p_now, p_now * r, fixed.p_min);
    const R G_now = shear_modulus(law_, memory, p_now, M_cur, surface.M_b, surface.M_d);
    const Point<R> at{p_now, alpha_now, normal_now, y.z, G_now, M_cur};
    const auto plastic = flow(law_, memory, at, surface, nearest_to_bound(law_));

    Evaluation out;
    const R K = R(law_.K_over_G) * G_now;
    const R K_plane = K + R(1.0 / 3.0) * G_now;
    const R nr = dot(normal_now, r);
    const R ne = dot(normal_now, d.e);
    const R twice_G = R(2.0) * G_now;
    const R Hd = plastic.K_p + twice_G - K * plastic.D * nr;
    const R least = R(0.02) * G_now;
    softened = softened + select(Hd < least, counted_, R(0.0));
    const R push = nr * d.v;
    const R elastic = twice_G * ne - K_plane * push;  // f' along the elastic path
    out.unloads = elastic < R(0.0);
    // Remark of section 8: use the average that the reference scheme has over its calls.
    const R driving = select(push > R(0.0), elastic, twice_G * ne - K * push);
    out.L = positive(driving) / larger(Hd, least);

    const R rate = K_plane * d.v - out.L * K * plastic.D;
    const auto held = (p_now <= floor()) & (rate < R(0.0));
    stalled = stalled + select(held, counted_, R(0.0));
    const R p_rate = select(held, R(0.0), rate);
    const R inverse_p = R(1.0) / p_now;
    const R flow_rate = R(2.0 / 3.0) * out.L * plastic.h;
    out.h = plastic.h;
    out.B = plastic.B;
    out.K_p = plastic.K_p;
    out.p = p_now;
    out.mu = flow_rate - p_rate * inverse_p;
    out.a_t = dot(tangent, alpha_now);
    out.a_n = dot(normal_now, alpha_now);
    out.pull = twice_G * ne * inverse_p;
    const R normal_rate = (twice_G * (ne - out.L) - nr * p_rate) * inverse_p;
    const R tangent_rate = -flow_rate * out.a_t;
    out.rate.p = p_rate;
    out.rate.along = turned.cosine * normal_rate - turned.sine * tangent_rate;
    out.rate.across = turned.sine * normal_rate + turned.cosine * tangent_rate;
    out.rate.theta =
        R(std::numbers::sqrt2 / m) * (twice_G * dot(tangent, d.e) * inverse_p + out.mu * out.a_t);
    out.rate.z = fabric_rate(memory, at, plastic, out.L);
    G = G_now;
    return out;
}

/// Rates at a later stage, with the fabric sums at that stage.
template <class R>
inline Unknowns<R> Walk<R>::stage(const Unknowns<R>& y, const R& time_now) {
    using namespace lanes;
    const R p_now = larger(y.p, floor());
    const Surfaces<R> surface = surfaces_at(p_now, time_now);
    const R moved = norm(y.z - z) * R(inverse_sqrt2);
    Fixed<R> memory = fixed;
    if (any(moved > R(0.0))) {
        memory.z_cum = fixed.z_cum + moved;
        memory.z_peak = larger(fixed.z_peak, norm(y.z) * R(inverse_sqrt2));
        prepare(law_, memory);
    }
    return evaluate(y, surface, memory).rate;
}

/// Returns to the bounding surface, as at the end of a call (section 14).
template <class R>
inline void Walk<R>::project(const Surfaces<R>& surface, const MaskOf<R>& busy) {
    using namespace lanes;
    const double m = law_.parameters.m;
    const Deviator<R> r = alpha + R(m * inverse_sqrt2) * n;
    const R M_cur = stress_ratio(p, p * r, fixed.p_min);
    const MaskOf<R> outside = (M_cur > surface.M_b) & busy;
    if (!any(outside)) return;
    projected = projected + select(outside, R(1.0), R(0.0));
    const Deviator<R> back = (surface.M_b / M_cur) * r;
    alpha = choose<R>(outside, ((surface.M_b - R(m)) / surface.M_b) * back, alpha);
    n = choose<R>(outside, (R(1.0) / norm(back)) * back, n);
}

template <class R>
inline MaskOf<R> Walk<R>::begin(const MaskOf<R>& busy) {
    using namespace lanes;
    counted_ = select(busy, R(1.0), R(0.0));
    const Surfaces<R> surface = surfaces_at(p, time);
    project(surface, busy);
    prepare(law_, fixed);
    const R zero(0.0);
    y_0_ = {p, dot(alpha, n), dot(alpha, t_0()), zero, z};
    const Evaluation at = evaluate(y_0_, surface, fixed);
    f_0_ = at.rate;
    const double steep = std::numbers::sqrt2 / law_.parameters.m;
    const R across = R(2.0 / 3.0) * at.L * at.h;
    J_.theta_theta = R(-steep) * positive(at.pull + at.mu * at.a_n);
    J_.theta_across = R(steep) * at.mu;
    J_.across_theta = across * at.a_n;
    J_.across_across = -across;
    J_.along_along = R(-0.5) * at.L * magnitude(at.K_p) / (larger(magnitude(at.B), R(1e-6)) * at.p);
    evaluations = evaluations + counted_;
    const MaskOf<R> reverses = dot(alpha - fixed.alpha_true, n) < R(reversed_below(law_));
    return (at.unloads | reverses) & busy;
}

namespace ros34pw2 {
constexpr double gamma = 4.3586652150845900e-01;
constexpr double a21 = 8.7173304301691801e-01;
constexpr double a31 = 8.4457060015369423e-01, a32 = -1.1299064236484185e-01;
constexpr double g21 = -8.7173304301691801e-01;
constexpr double g31 = -9.0338057013044082e-01, g32 = 5.4180672388095326e-02;
constexpr double g41 = 2.4212380706095346e-01, g42 = -1.2232505839045147e+00,
                 g43 = 5.4526025533510214e-01;
constexpr double b1 = g41, b2 = g42, b3 = 1.0 + g43, b4 = gamma;
constexpr double e1 = b1 - 3.7810903145819369e-01, e2 = b2 + 9.6042292212423178e-02,
                 e3 = b3 - 5.0000000000000000e-01, e4 = b4 - 2.1793326075422950e-01;
}  // namespace ros34pw2

template <class R>
inline MaskOf<R> Walk<R>::advance(const MaskOf<R>& moving) {
    using namespace lanes;
    using namespace ros34pw2;
    const R zero(0.0), one(1.0);
    counted_ = select(moving, one, zero);
    const R h = step;
    const R gh = R(gamma) * h;

    const auto scaled = [&](const Unknowns<R>& f) {
        return Unknowns<R>{h * f.p, h * f.along, h * f.across, h * f.theta, h * f.z};
    };
    Unknowns<R> k1 = scaled(f_0_);
    J_.solve(gh, k1);

    Unknowns<R> k2 = scaled(stage(y_0_.plus(a21, k1), time + R(a21) * h));
    J_.multiply(k1.times(g21), h, k2);
    J_.solve(gh, k2);

    Unknowns<R> k3 = scaled(stage(y_0_.plus(a31, k1).plus(a32, k2), time + R(a31 + a32) * h));
    J_.multiply(k1.times(g31).plus(g32, k2), h, k3);
    J_.solve(gh, k3);

    Unknowns<R> k4 = scaled(stage(y_0_.plus(1.0, k3), time + h));
    J_.multiply(k1.times(g41).plus(g42, k2).plus(g43, k3), h, k4);
    J_.solve(gh, k4);
    evaluations = evaluations + R(3.0) * counted_;

    const Unknowns<R> y = y_0_.plus(b1, k1).plus(b2, k2).plus(b3, k3).plus(b4, k4);
    const Unknowns<R> gap = k1.times(e1).plus(e2, k2).plus(e3, k3).plus(e4, k4);
    const R p_hat = larger(p, fixed.p_min);
    const R error = magnitude(gap.p) / p_hat +
                    root(gap.along * gap.along + gap.across * gap.across) +
                    R(law_.parameters.m * inverse_sqrt2) * magnitude(gap.theta) +
                    R(0.3) * norm(gap.z) * fixed.inverse_z;

    // With a NaN the step counts as inexact and shrinks; the walk ends at the smallest step.
    const R tolerance(options_.tolerance);
    const R least = least_step();
    const MaskOf<R> exact = error <= tolerance;
    const MaskOf<R> smallest = h <= least;
    const MaskOf<R> finite = error < R(1e300);
    const MaskOf<R> accepted = (exact | (smallest & finite)) & moving;
    const MaskOf<R> lost = smallest & !finite & moving;
    const R ratio = larger(tolerance / larger(error, R(1e-12)), R(1e-9));
    const R factor = R(0.9) * exponential(logarithm(select(finite, ratio, R(1e-9))) * R(1.0 / 3.0));
    const R next = larger(h * larger(smaller(factor, R(4.0)), R(0.2)), least);

    sub_steps = sub_steps + select(accepted, one, zero);
    rejected = rejected + select(accepted, zero, counted_);
    forced = forced + select(accepted & !exact, one, zero);

    const auto turned = turn(y.theta);
    const Deviator<R> alpha_new = y.along * n + y.across * t_0();
    const Deviator<R> n_new = turned.cosine * n + turned.sine * t_0();
    // Normalise n: thousands of rotations would change its length.
    alpha = choose<R>(accepted, alpha_new, alpha);
    n = choose<R>(accepted, (one / norm(n_new)) * n_new, n);
    fixed.z_cum = fixed.z_cum + select(accepted, norm(y.z - z) * R(inverse_sqrt2), zero);
    fixed.z_peak =
        select(accepted, larger(fixed.z_peak, norm(y.z) * R(inverse_sqrt2)), fixed.z_peak);
    z = choose<R>(accepted, y.z, z);
    p = select(accepted, larger(y.p, floor()), p);
    time = select(accepted, time + h, time);
    proposed = select(accepted, next, proposed);
    const R rest = one - time;
    // The last step takes the rest; if it would leave a tiny rest, the rest is halved.
    const R planned = select(next >= rest, rest, select(next * R(2.0) > rest, R(0.5) * rest, next));
    step = select(moving, planned, step);
    return lost;
}

}  // namespace breach::materials::pm4sand
