// What surrounds the adaptive scheme's walk in a call: opening, unloading, closing. Shared by one
// point and several side by side.
#pragma once

#include "core/materials/calls.hpp"
#include "core/materials/pm4sand/call.hpp"
#include "core/materials/pm4sand/walk.hpp"

namespace breach::materials::pm4sand {

/// One call in progress: the data that a walk's lane does not contain.
struct Task {
    Update* update;          ///< new state and counts
    Strain<double> plastic;  ///< strain after the elastic part
    double epsilon_v;        ///< volumetric strain before the plastic part
    Plane n;                 ///< plastic direction at the beginning of the plastic part
};

/// Integrates the elastic part. True if plastic strain remains.
bool open_call(const Ready& law, const State& old, const Strain<double>& d, Task& task);

/// Elastic path of a point that unloads from the yield cone.
struct Excursion {
    enum class End { nowhere, inside, on_cone } end;
    Stress sigma;     ///< at its end
    Plane n;          ///< normal at its end, if on the cone
    double fraction;  ///< share of the given strain that it used
};
Excursion unload(const Ready& law, const Stress& sigma, const Plane& alpha, double G,
                 const Strain<double>& rest, double floor);

/// Closes a call whose update contains the final p, s, alpha, z and fabric sums.
void finish_call(const Ready& law, const State& old, const Strain<double>& d, Task& task);

template <class R>
[[gnu::always_inline]] inline void set_lane(Deviator<R>& a, int i, const Plane& value) {
    lanes::set_lane(a.d, i, value.d);
    lanes::set_lane(a.x, i, value.x);
}
template <class R>
[[gnu::always_inline]] inline Plane lane(const Deviator<R>& a, int i) {
    return {lanes::lane(a.d, i), lanes::lane(a.x, i)};
}

/// Copies into lane i what a reversal changes.
template <class R>
[[gnu::always_inline]] inline void load_reversal(const State& s, int i, Fixed<R>& f) {
    pm4sand::set_lane(f.alpha_app, i, deviator(s.alpha_app));
    pm4sand::set_lane(f.alpha_true, i, s.alpha_true);
    pm4sand::set_lane(f.alpha_prev, i, s.alpha_prev);
    pm4sand::set_lane(f.z_in, i, s.z_in);
    lanes::set_lane(f.p_zp, i, s.p_zp);
}

/// Copies an opened task into lane i.
template <class R>
[[gnu::always_inline]] inline void load(const Task& task, int i, Walk<R>& walk) {
    using lanes::set_lane;
    const State& s = task.update->state;
    const Strain<double>& d = task.plastic;
    const double size = std::sqrt(0.5 * d.v * d.v + dot(d.e, d.e));
    set_lane(walk.p, i, s.p);
    set_lane(walk.time, i, 0.0);
    set_lane(walk.step, i, std::min(1.0, s.sub_step / size));
    set_lane(walk.proposed, i, s.sub_step / size);
    set_lane(walk.size, i, size);
    set_lane(walk.epsilon_v, i, task.epsilon_v);
    set_lane(walk.d.v, i, d.v);
    pm4sand::set_lane(walk.d.e, i, d.e);
    pm4sand::set_lane(walk.alpha, i, s.alpha);
    pm4sand::set_lane(walk.n, i, task.n);
    pm4sand::set_lane(walk.z, i, s.z);
    Fixed<R>& f = walk.fixed;
    load_reversal(s, i, f);
    set_lane(f.z_cum, i, s.z_cum);
    set_lane(f.z_peak, i, s.z_peak);
    set_lane(f.A_do, i, s.A_do);
    set_lane(f.z_max, i, s.z_max);
    set_lane(f.p_min, i, s.p_min);
    set_lane(f.p_min2, i, s.p_min2);
    for (R* count : walk.counts()) set_lane(*count, i, 0.0);
}

/// Copies lane i back into its task.
template <class R>
[[gnu::always_inline]] inline void store(const Ready& law, int i, const Walk<R>& walk, Task& task) {
    using lanes::lane;
    State& s = task.update->state;
    s.p = lane(walk.p, i);
    s.alpha = pm4sand::lane(walk.alpha, i);
    const Plane n = pm4sand::lane(walk.n, i);
    s.s = s.p * (s.alpha + (law.parameters.m * inverse_sqrt2) * n);
    s.z = pm4sand::lane(walk.z, i);
    s.z_cum = lane(walk.fixed.z_cum, i);
    s.z_peak = lane(walk.fixed.z_peak, i);
    s.sub_step = lane(walk.proposed, i) * lane(walk.size, i);
    const auto number = [i](const R& count) { return static_cast<int>(lane(count, i)); };
    task.update->counts += {.evaluations = number(walk.evaluations),
                            .sub_steps = number(walk.sub_steps),
                            .rejected = number(walk.rejected),
                            .forced = number(walk.forced),
                            .projected = number(walk.projected),
                            .softened = number(walk.softened),
                            .stalled = number(walk.stalled)};
}

/// Applies an elastic excursion to lane i.
template <class R>
[[gnu::always_inline]] inline Excursion::End excursion(const Ready& law, int i, Walk<R>& walk,
                                                       Task& task) {
    using lanes::lane;
    using lanes::set_lane;
    const double p = lane(walk.p, i);
    const Plane alpha = pm4sand::lane(walk.alpha, i);
    const Plane n = pm4sand::lane(walk.n, i);
    const double left = 1.0 - lane(walk.time, i);
    const Strain<double> rest{left * task.plastic.v, left * task.plastic.e};
    const Stress sigma{p, p * (alpha + (law.parameters.m * inverse_sqrt2) * n)};
    const Excursion path =
        unload(law, sigma, alpha, lane(walk.G, i), rest, 0.2 * task.update->state.p_min);
    if (path.end == Excursion::End::nowhere) return path.end;
    set_lane(walk.p, i, path.sigma.p);
    if (path.end == Excursion::End::inside) {
        store(law, i, walk, task);
        task.update->state.s = path.sigma.s;
        return path.end;
    }
    pm4sand::set_lane(walk.n, i, path.n);
    const double time = 1.0 - left * (1.0 - path.fraction);
    set_lane(walk.time, i, path.fraction >= 1.0 ? 1.0 : time);
    set_lane(walk.step, i, std::min(lane(walk.step, i), 1.0 - time));
    return path.end;
}

/// Tests for a reversal (section 11) anywhere on the plastic path: a point's history does not
/// depend on how its strain is divided into calls.
template <class R>
[[gnu::always_inline]] inline bool reverses(const Ready& law, int i, Walk<R>& walk, Task& task) {
    State& s = task.update->state;
    const Plane alpha = pm4sand::lane(walk.alpha, i);
    const Plane n = pm4sand::lane(walk.n, i);
    if (dot(alpha - s.alpha_true, n) >= reversed_below(law)) return false;
    s.p = lanes::lane(walk.p, i);
    s.alpha = alpha;
    s.z = pm4sand::lane(walk.z, i);
    reverse(n, s);
    load_reversal(s, i, walk.fixed);
    return true;
}

/// Handles lane i after `begin` found that it unloads or reverses.
template <class R>
[[gnu::always_inline]] inline Next after_unloading(const Ready& law, int i, Walk<R>& walk,
                                                   Task& task) {
    if (reverses(law, i, walk, task)) return Next::again;
    switch (excursion(law, i, walk, task)) {
        case Excursion::End::nowhere:
            return Next::walk;
        case Excursion::End::inside:
            return Next::leave;
        case Excursion::End::on_cone:
            break;
    }
    if (lanes::lane(walk.time, i) < 1.0) return Next::again;
    store(law, i, walk, task);
    return Next::leave;
}

/// Whether lane i has ended after `advance` or before `begin`, and with which outcome.
template <class R>
[[gnu::always_inline]] inline bool ends(int i, const Walk<R>& walk, bool lost,
                                        const Options& options, Task& task) {
    const bool stuck = lost || lanes::lane(walk.evaluations, i) > options.most_evaluations;
    if (stuck) task.update->outcome = Outcome::unresolved;
    return stuck || lanes::lane(walk.time, i) >= 1.0;
}

inline bool may_be_tried(const Strain<double>& d, const Options&) { return is_finite(d); }

struct Calls {
    using Ready = pm4sand::Ready;
    using State = pm4sand::State;
    using Strain = pm4sand::Strain<double>;
    using Options = pm4sand::Options;
    using Update = pm4sand::Update;
    using Task = pm4sand::Task;
    template <class R>
    using Walk = pm4sand::Walk<R>;
    static Strain strain(const Voigt& d_epsilon) { return inward(d_epsilon); }
};

Update integrate_adaptive(const Ready& law, const State& old, const Strain<double>& d,
                          const Options& options);

}  // namespace breach::materials::pm4sand
