// What surrounds the walk (walk.hpp) in a call: the elastic part up to the yield surface,
// unloading, and closing at the floor p_min (sections 4, 8, 10). Shared by one point and several
// side by side.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/materials/calls.hpp"
#include "core/materials/norsand/walk.hpp"

namespace breach::materials::norsand {

using Strain = Components<double>;

/// The strain increment with compression positive, from one with tension positive.
Strain inward(const Voigt& d_epsilon);
bool may_be_tried(const Strain& d, const Options& options);

/// Deviator of a strain, scaled as a stress with q = 1; zero for a zero deviator.
Components<double> direction_of(const Strain& d);

/// Lower limit of the guessed sub-step. After a call with a strain of round-off size, a smaller
/// guess would cost the next call all its evaluations in doublings.
inline constexpr double least_guess = 1e-8;  // strain

/// One call in progress: the data that a walk's lane does not contain.
struct Task {
    Update* update;  ///< new state and counts
    Strain plastic;  ///< strain after the elastic part
};

/// Integrates the elastic part. True if plastic strain remains.
bool open_call(const Ready& law, const State& old, const Strain& d, Task& task);

/// Moves a state that unloads along the strain `rest` and returns the elastic share. 1: all of it;
/// 0: none, the apparent unloading was neutral loading.
double unload(const Ready& law, const Strain& rest, State& state);

/// Closes a call: void ratio, floor, tension; restores the old state if the call failed.
void finish_call(const Ready& law, const State& old, const Strain& d, Task& task);

template <class R>
[[gnu::always_inline]] inline void set_lane(Components<R>& a, int i,
                                            const Components<double>& value) {
    lanes::set_lane(a.xx, i, value.xx);
    lanes::set_lane(a.yy, i, value.yy);
    lanes::set_lane(a.zz, i, value.zz);
    lanes::set_lane(a.xy, i, value.xy);
}
template <class R>
[[gnu::always_inline]] inline Components<double> lane(const Components<R>& a, int i) {
    return {lanes::lane(a.xx, i), lanes::lane(a.yy, i), lanes::lane(a.zz, i), lanes::lane(a.xy, i)};
}
inline Components<double> stress_of(const State& state) {
    return {state.xx, state.yy, state.zz, state.xy};
}
inline void set_stress(State& state, const Components<double>& sigma) {
    state.xx = sigma.xx;
    state.yy = sigma.yy;
    state.zz = sigma.zz;
    state.xy = sigma.xy;
}

/// Copies an opened task into lane i.
template <class R>
[[gnu::always_inline]] inline void load(const Task& task, int i, Walk<R>& walk) {
    using lanes::set_lane;
    const State& s = task.update->state;
    const Strain& d = task.plastic;
    const double size = std::max(norm(d), 1e-300);
    norsand::set_lane(walk.sigma, i, stress_of(s));
    set_lane(walk.p_i, i, s.p_i);
    set_lane(walk.epsilon_q, i, s.epsilon_q);
    set_lane(walk.e, i, s.e);
    set_lane(walk.chi_i, i, s.chi_i);
    set_lane(walk.time, i, 0.0);
    set_lane(walk.step, i, std::min(1.0, s.sub_step / size));
    set_lane(walk.proposed, i, s.sub_step / size);
    norsand::set_lane(walk.d, i, d);
    set_lane(walk.volume, i, trace(d));
    norsand::set_lane(walk.direction, i, direction_of(d));
    set_lane(walk.floored, i, 0.0);
    for (R* count : walk.counts()) set_lane(*count, i, 0.0);
}

/// Copies lane i back into its task.
template <class R>
[[gnu::always_inline]] inline void store(const Ready&, int i, const Walk<R>& walk, Task& task) {
    using lanes::lane;
    State& s = task.update->state;
    set_stress(s, norsand::lane(walk.sigma, i));
    s.p_i = lane(walk.p_i, i);
    s.epsilon_q = lane(walk.epsilon_q, i);
    s.sub_step = std::max(lane(walk.proposed, i) * norm(task.plastic), least_guess);
    s.on_floor = lane(walk.floored, i) > 0.0;
    const auto number = [i](const R& count) { return static_cast<int>(lane(count, i)); };
    task.update->counts += {.evaluations = number(walk.evaluations),
                            .sub_steps = number(walk.sub_steps),
                            .rejected = number(walk.rejected),
                            .guarded = number(walk.guarded),
                            .floored = 0,
                            .cut_off = 0};
}

/// Handles lane i after `begin` found that it unloads.
template <class R>
[[gnu::always_inline]] inline Next after_unloading(const Ready& law, int i, Walk<R>& walk,
                                                   Task& task) {
    const double time = lanes::lane(walk.time, i);
    const double left = 1.0 - time;
    State at = task.update->state;
    set_stress(at, norsand::lane(walk.sigma, i));
    at.p_i = lanes::lane(walk.p_i, i);
    at.e = (1.0 + at.e) * std::exp(-time * lanes::lane(walk.volume, i)) - 1.0;
    const double elastic = unload(law, left * task.plastic, at);
    if (elastic <= 0.0) return Next::walk;
    norsand::set_lane(walk.sigma, i, stress_of(at));
    lanes::set_lane(walk.p_i, i, at.p_i);
    if (elastic >= 1.0) {
        lanes::set_lane(walk.time, i, 1.0);
        store(law, i, walk, task);
        return Next::leave;
    }
    const double there = 1.0 - left * (1.0 - elastic);
    lanes::set_lane(walk.time, i, there);
    lanes::set_lane(walk.step, i, std::min(lanes::lane(walk.step, i), 1.0 - there));
    return Next::again;
}

/// Whether lane i has ended after `advance` or before `begin`, and with which outcome.
template <class R>
[[gnu::always_inline]] inline bool ends(int i, const Walk<R>& walk, bool lost,
                                        const Options& options, Task& task) {
    const bool over = lanes::lane(walk.time, i) >= 1.0 || lanes::lane(walk.floored, i) > 0.0;
    const bool stuck =
        lost || (!over && lanes::lane(walk.evaluations, i) > options.most_evaluations);
    if (stuck) task.update->outcome = Outcome::unresolved;
    return stuck || over;
}

struct Calls {
    using Ready = norsand::Ready;
    using State = norsand::State;
    using Strain = norsand::Strain;
    using Options = norsand::Options;
    using Update = norsand::Update;
    using Task = norsand::Task;
    template <class R>
    using Walk = norsand::Walk<R>;
    static Strain strain(const Voigt& d_epsilon) { return inward(d_epsilon); }
};

}  // namespace breach::materials::norsand
