// The plastic part of a call, section 11, for one point (double) or several side by side (Lanes):
// modified Euler with error control (Sloan, Abbo & Sheng 2001) and a return to the yield surface
// after each sub-step.
#pragma once

#include <array>

#include "core/materials/norsand/functions.hpp"

namespace breach::materials::norsand {

template <class R>
class Walk {
  public:
    Walk(const Ready& law, const Options& options) : law_(law), options_(options) {}

    // Present state.
    Components<R> sigma;
    R p_i, epsilon_q;
    R e;  ///< void ratio at time 0
    R chi_i;
    R time, step;     ///< time: share of the call's plastic strain that is done; step: next share
    R proposed;       ///< next step by the error control
    Components<R> d;  ///< the call's plastic strain
    R volume;         ///< of d
    Components<R> direction;  ///< of its deviator, scaled as a stress with q = 1
    R floored;                ///< 1: p has fallen to p_min
    R evaluations, sub_steps, rejected, guarded;
    std::array<R*, 4> counts() { return {&evaluations, &sub_steps, &rejected, &guarded}; }

    /// Evaluates the rates at the present state; returns the lanes that unload.
    [[gnu::always_inline]] MaskOf<R> begin(const MaskOf<R>& busy);
    /// Tries one sub-step and accepts or rejects it lane by lane. Returns the lanes that cannot
    /// continue.
    [[gnu::always_inline]] MaskOf<R> advance(const MaskOf<R>& moving);

  private:
    /// Rates per unit of `time`.
    struct Rates {
        Components<R> sigma;
        R p_i, epsilon_q;
        Flow<R> flow;
        MaskOf<R> unloads;
    };
    [[gnu::always_inline]] R void_ratio(const R& at) const {
        return (R(1.0) + e) * lanes::exponential(-(at * volume)) - R(1.0);
    }
    [[gnu::always_inline]] Rates rates_at(const Components<R>& stress, const R& size,
                                          const R& at) const;
    /// Returns a trial state to the yield surface along the flow direction of its last stage.
    [[gnu::always_inline]] MaskOf<R> correct(Place<R>& place, const Flow<R>& flow,
                                             const MaskOf<R>& busy);

    const Ready& law_;
    const Options& options_;
    Rates first_;
};

template <class R>
inline typename Walk<R>::Rates Walk<R>::rates_at(const Components<R>& stress, const R& size,
                                                 const R& at) const {
    using namespace lanes;
    const Place<R> place{stress, size, void_ratio(at), chi_i};
    const Surface<R> surface = surface_at(law_, place, direction);
    Rates out;
    out.flow = flow_at(law_, place, surface);
    const Flow<R>& flow = out.flow;
    const R drive = loading(flow, place.e, d);
    out.unloads = drive < R(0.0);
    // `advance` rejects A <= 0; the rates must only be finite.
    out.epsilon_q = positive(drive) / select(flow.A > R(0.0), flow.A, flow.G);
    const Components<R> dev = deviator(d, volume * R(1.0 / 3.0));
    out.sigma =
        elastic(flow.G, flow.K, dev - out.epsilon_q * flow.r, volume - out.epsilon_q * flow.D);
    out.p_i = flow.h * out.epsilon_q;
    return out;
}

template <class R>
inline MaskOf<R> Walk<R>::begin(const MaskOf<R>& busy) {
    using namespace lanes;
    first_ = rates_at(sigma, p_i, time);
    evaluations = evaluations + select(busy, R(1.0), R(0.0));
    return first_.unloads & busy;
}

template <class R>
inline MaskOf<R> Walk<R>::correct(Place<R>& place, const Flow<R>& flow, const MaskOf<R>& busy) {
    using namespace lanes;
    constexpr int most_passes = 5;
    const R allowed(1e-4 * options_.tolerance);
    const Components<R> back = elastic(flow.G, flow.K, flow.r, flow.D);
    MaskOf<R> far = busy & !busy;
    for (int pass = 0; pass < most_passes; ++pass) {
        const Surface<R> surface = surface_at(law_, place, direction);
        if (pass == 0) far = magnitude(surface.F) > R(1e-2) * surface.p;
        const MaskOf<R> off = (magnitude(surface.F) > allowed * surface.p) & busy & !far;
        if (!any(off)) break;
        const R multiplier = select(off, surface.F / flow.A, R(0.0));
        place.sigma = place.sigma - multiplier * back;
        place.p_i = place.p_i + flow.h * multiplier;
    }
    return far;
}

template <class R>
inline MaskOf<R> Walk<R>::advance(const MaskOf<R>& moving) {
    using namespace lanes;
    const R one(1.0), none(0.0);
    const R next = time + step;
    const Components<R> there = sigma + step * first_.sigma;
    const R size = p_i + step * first_.p_i;
    evaluations = evaluations + select(moving, one, none);
    const MaskOf<R> first_stands = (trace(there) > none) & (size > none) & (first_.flow.A > none);
    const Rates second =
        rates_at(choose(first_stands, there, sigma), select(first_stands, size, p_i), next);
    const R half = R(0.5) * step;
    const R way = half * (first_.epsilon_q + second.epsilon_q);
    Place<R> place{sigma + half * (first_.sigma + second.sigma),
                   p_i + half * (first_.p_i + second.p_i), void_ratio(next), chi_i};
    const R gap = half * norm(second.sigma - first_.sigma) / norm(place.sigma);
    const R size_gap = half * magnitude((second.p_i - first_.p_i) / place.p_i);
    const R tolerance(options_.tolerance);
    const R error = larger(gap, size_gap);
    MaskOf<R> stands =
        first_stands & (trace(place.sigma) > none) & (place.p_i > none) & (second.flow.A > none);
    // A trial without a valid state counts as an error of 1e6 times the tolerance.
    const R room = select(stands, error, R(1e6) * tolerance);
    const R growth = R(0.9) * root(tolerance / larger(room, R(1e-6) * tolerance));
    const R factor = larger(smaller(growth, R(2.0)), R(0.1));
    stands = stands & (error <= tolerance) & moving;
    if (any(stands)) {
        const MaskOf<R> far = correct(place, second.flow, stands);
        stands = stands & !far & (trace(place.sigma) > none) & (place.p_i > none);
    }
    const MaskOf<R> failed = moving & !stands;
    sigma = choose(stands, place.sigma, sigma);
    p_i = select(stands, place.p_i, p_i);
    epsilon_q = select(stands, epsilon_q + way, epsilon_q);
    const R rest = one - next;
    const MaskOf<R> over = stands & (rest <= R(1e-12));
    time = select(over, one, select(stands, next, time));
    // Too far off the surface for its error estimate to be valid: halve.
    const R shrunk = step * smaller(factor, R(0.5));
    proposed = select(moving, select(stands, step * factor, shrunk), proposed);
    step = select(moving, smaller(proposed, one - time), step);
    sub_steps = sub_steps + select(stands, one, none);
    rejected = rejected + select(failed, one, none);
    guarded = guarded + select(stands & (first_.flow.guarded | second.flow.guarded), one, none);
    floored = select(stands & (trace(sigma) < R(3.0 * law_.parameters.p_min)), one, floored);
    return failed & (proposed < R(options_.least_time_step));
}

}  // namespace breach::materials::norsand
