#include "core/materials/pm4sand/adaptive.hpp"

#include <algorithm>
#include <cmath>

namespace breach::materials::pm4sand {

namespace {

/// Plastic direction at the end of an elastic path; the direction of loading if the stress is on
/// the cone's axis.
Plane direction(const Ready& law, const Stress& sigma, const Plane& alpha,
                const Strain<double>& d) {
    const Plane across = sigma.s - sigma.p * alpha;
    const double size = norm(across);
    if (size > 1e-10 * law.unit) return (1.0 / size) * across;
    const double shear = norm(d.e);
    return shear > 0.0 ? (1.0 / shear) * d.e : Plane{0.0, 1.0};
}

}  // namespace

bool open_call(const Ready& law, const State& old, const Strain<double>& d, Task& task) {
    *task.update = {old, Outcome::done, {}};
    State& state = task.update->state;
    const Stress change = elastic_change(law, state.G, d);
    const double a = elastic_fraction(law, {state.p, state.s}, state.alpha, change);
    const Stress sigma{state.p + a * change.p, state.s + a * change.s};
    state.p = std::max(sigma.p, 0.2 * state.p_min);
    state.s = sigma.s;
    if (a >= 1.0) return false;
    task.plastic = {(1.0 - a) * d.v, (1.0 - a) * d.e};
    task.epsilon_v = old.epsilon_v + a * d.v;
    task.n = direction(law, sigma, state.alpha, d);
    if (!(state.sub_step > 0.0)) state.sub_step = 1e-5;
    return true;
}

Excursion unload(const Ready& law, const Stress& sigma, const Plane& alpha, double G,
                 const Strain<double>& rest, double floor) {
    const Stress change = elastic_change(law, G, rest);
    const Stress trial{sigma.p + change.p, sigma.s + change.s};
    if (yield_function(law, trial, alpha) <= 1e-8 * law.unit) {
        return {Excursion::End::inside, {std::max(trial.p, floor), trial.s}, {0.0, 1.0}, 1.0};
    }
    const double t = last_crossing(law, sigma, alpha, change);
    // Shorter paths are round-off.
    if (t <= 1e-9) return {Excursion::End::nowhere, sigma, {0.0, 1.0}, 0.0};
    const Stress there{sigma.p + t * change.p, sigma.s + t * change.s};
    return {Excursion::End::on_cone,
            {std::max(there.p, floor), there.s},
            direction(law, there, alpha, rest),
            t};
}

void finish_call(const Ready& law, const State& old, const Strain<double>& d, Task& task) {
    Update& update = *task.update;
    State& state = update.state;
    if (update.outcome == Outcome::done) {
        state.epsilon_v = old.epsilon_v + d.v;
        const double p_hat = std::max(state.p, state.p_min);
        state.M_b = surfaces(law, p_hat, density(law, state.epsilon_v)).M_b;
        close_call(law, state.z, state, update.counts);
        if (is_finite(state)) return;
        update.outcome = Outcome::unresolved;
    }
    state = old;
}

Update integrate_adaptive(const Ready& law, const State& old, const Strain<double>& d,
                          const Options& options) {
    return call_alone<Calls>(law, old, d, options);
}

}  // namespace breach::materials::pm4sand
