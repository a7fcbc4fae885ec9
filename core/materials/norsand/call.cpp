#include "core/materials/norsand/call.hpp"

#include <algorithm>
#include <cmath>

#include "core/materials/norsand/image.hpp"

namespace breach::materials::norsand {

Strain inward(const Voigt& d) { return {-d[0], -d[1], -d[2], -d[3]}; }

bool may_be_tried(const Strain& d, const Options& options) {
    // Written so that NaN fails.
    const double most = options.largest_strain;
    return std::abs(d.xx) <= most && std::abs(d.yy) <= most && std::abs(d.zz) <= most &&
           std::abs(d.xy) <= most;
}

Components<double> direction_of(const Strain& d) {
    Components<double> dev = deviator(d, trace(d) / 3.0);
    dev.xy *= 0.5;
    const double size = shear_measure(dev);
    // The round-off of a volumetric strain is no direction.
    if (!(size > 1e-12 * norm(d))) return {0.0, 0.0, 0.0, 0.0};
    return (1.0 / size) * dev;
}

namespace {

constexpr double near_surface = 1e-7;   ///< |F| / p that counts as on the surface
constexpr double found_surface = 1e-9;  ///< section 10

/// Size of the yield surface through a stress [Pa].
double size_through(const Ready& law, const State& state) {
    const Components<double> sigma = stress_of(state);
    const double p = trace(sigma) / 3.0;
    const Components<double> s = deviator(sigma, p);
    const double M = law.parameters.M_tc - law.M_fall * axes_of(s).half_cosine;
    return image_size(law, {p, shear_measure(s) / p, M, state.e, state.chi_i});
}

/// Yield surface on an elastic path with `Unloading::capped`. shrinks: to the limiting size, so
/// that the stress may meet it; follows: no smaller than through the stress.
enum class Cap { shrinks, follows };

/// Elastic strain from a state, section 10.
class ElasticPath {
  public:
    ElasticPath(const Ready& law, const State& from, const Strain& d, Cap cap)
        : law_(law),
          from_(from),
          d_(d),
          cap_(cap),
          volume_(trace(d)),
          p_0_(trace(stress_of(from)) / 3.0) {
        const Parameters& par = law.parameters;
        const double p = std::max(p_0_, par.p_min);
        const double ln_p = std::log(p / kPa);
        G_0_ = norsand::shear_modulus(law, p, ln_p);
        const double ln_floor = std::log(par.p_min / kPa);
        K_floor_ = law.K_over_G * norsand::shear_modulus(law, par.p_min, ln_floor);
    }

    /// State after the share `a` of the strain, with the capped surface.
    State at(double a) const {
        const double volume = a * volume_;
        const double p = mean_stress(volume);
        const double G = secant(volume, p);
        const Components<double> s_0 = deviator(stress_of(from_), p_0_);
        const Strain dev = a * deviator(d_, volume_ / 3.0);
        const double twice = 2.0 * G;
        State out = from_;
        out.xx = p + s_0.xx + twice * dev.xx;
        out.yy = p + s_0.yy + twice * dev.yy;
        out.zz = p + s_0.zz + twice * dev.zz;
        out.xy = s_0.xy + G * dev.xy;
        out.e = (1.0 + from_.e) * std::exp(-volume) - 1.0;
        if (law_.parameters.unloading == Unloading::capped && p > 0.0) {
            out.p_i = capped_size(law_, p, out.e, out.chi_i, from_.p_i);
            if (cap_ == Cap::follows && out.p_i < from_.p_i) {
                out.p_i = std::min(std::max(out.p_i, size_through(law_, out)), from_.p_i);
            }
        }
        return out;
    }

    /// Yield function over max(p, p_min); positive in tension.
    double excess(const State& state) const {
        const double p = trace(stress_of(state)) / 3.0;
        const double scale = std::max(p, law_.parameters.p_min);
        if (p <= 0.0) return 1.0 - p / scale;
        const Place<double> place{stress_of(state), state.p_i, state.e, state.chi_i};
        return surface_at(law_, place, {0.0, 0.0, 0.0, 0.0}).F / scale;
    }
    double excess(double a) const { return excess(at(a)); }

  private:
    double mean_stress(double volume) const {
        const Parameters& par = law_.parameters;
        const double p_min = par.p_min;
        if (p_0_ <= p_min && volume <= 0.0) return p_0_ + K_floor_ * volume;
        const double p_0 = std::max(p_0_, p_min);
        const double rate = law_.K_over_G * par.G_ref * std::pow(par.p_ref, -par.m);
        if (par.m == 1.0) {
            const double ln = rate * volume;
            const double way = std::log(p_min / p_0);
            return ln >= way ? p_0 * std::exp(ln) : p_min + K_floor_ * (volume - way / rate);
        }
        const double n = 1.0 - par.m;
        const double base = std::pow(p_0, n) + n * rate * volume;
        const double least = std::pow(p_min, n);
        if (base >= least) return std::pow(base, 1.0 / n);
        return p_min + K_floor_ * (base - least) / (n * rate);
    }
    double secant(double volume, double p) const {
        const double K_0 = law_.K_over_G * G_0_;
        const double stretch = K_0 * volume / std::max(p_0_, law_.parameters.p_min);
        if (std::abs(stretch) > 1e-6) return (p - p_0_) / (law_.K_over_G * volume);
        return G_0_ * (1.0 + 0.5 * law_.parameters.m * stretch);
    }

    const Ready& law_;
    const State& from_;
    const Strain& d_;
    Cap cap_;
    double volume_, p_0_;
    double G_0_, K_floor_;
};

/// Share of the path at which it meets the yield surface, between `a` (inside) and `b` (outside),
/// by the Pegasus method.
double crossing(const ElasticPath& path, double a, double F_a, double b, double F_b) {
    double at = b;
    for (int pass = 0; pass < 100; ++pass) {
        at = b - F_b * (b - a) / (F_b - F_a);
        const double F = path.excess(at);
        if (std::abs(F) <= found_surface || std::abs(b - a) < 1e-15) break;
        if (F * F_b < 0.0) {
            a = b;
            F_a = F_b;
        } else {
            F_a *= F_b / (F_b + F);
        }
        b = at;
        F_b = F;
    }
    return at;
}

/// Section 8: p = p_min.
void hold_at_floor(const Ready& law, State& state) {
    const double p_min = law.parameters.p_min;
    const Components<double> sigma = stress_of(state);
    Components<double> s = deviator(sigma, trace(sigma) / 3.0);
    const double q = shear_measure(s);
    const Axes<double> axes = axes_of(s);
    const double M = law.parameters.M_tc - law.M_fall * axes.half_cosine;
    if (q > M * p_min) s = (M * p_min / q) * s;
    set_stress(state, {p_min + s.xx, p_min + s.yy, p_min + s.zz, s.xy});
    state.p_i = image_size(law, {p_min, std::min(q / p_min, M), M, state.e, state.chi_i});
    state.on_floor = true;
}

/// Section 8: removes tension by scaling the deviator until the least principal stress is 0. The
/// yield surface stays; the point is inside. True if there was tension.
bool cut_off_tension(State& state) {
    const Components<double> sigma = stress_of(state);
    const double p = trace(sigma) / 3.0;
    const double half = 0.5 * (sigma.xx - sigma.yy);
    const double in_plane =
        0.5 * (sigma.xx + sigma.yy) - std::sqrt(half * half + sigma.xy * sigma.xy);
    const double least = std::min(in_plane, sigma.zz);
    if (least >= 0.0) return false;
    const Components<double> s = (p / (p - least)) * deviator(sigma, p);
    set_stress(state, {p + s.xx, p + s.yy, p + s.zz, s.xy});
    return true;
}

/// Section 11: smallest strain to subdivide; if it cannot be integrated, smaller parts would not
/// help.
constexpr double least_followed = 1e-6;

/// Section 11: if the surface shrinks faster than strain can follow (A <= 0), the stress falls at
/// constant strain to the critical state of the void ratio, or to the floor.
void fall(const Ready& law, State& state) {
    const Components<double> sigma = stress_of(state);
    const double p_old = trace(sigma) / 3.0;
    Components<double> s = deviator(sigma, p_old);
    const double q = shear_measure(s);
    const double M = law.parameters.M_tc - law.M_fall * axes_of(s).half_cosine;
    const double p =
        std::max(std::min(p_old, critical_pressure(law, state.e)), law.parameters.p_min);
    if (q > M * p) s = (M * p / q) * s;
    set_stress(state, {p + s.xx, p + s.yy, p + s.zz, s.xy});
    state.p_i = image_size(law, {p, std::min(q / p, M), M, state.e, state.chi_i});
}

bool is_finite(const State& s) {
    for (const double each : {s.xx, s.yy, s.zz, s.xy, s.p_i, s.e, s.epsilon_q, s.sub_step}) {
        if (!std::isfinite(each)) return false;
    }
    return s.p_i > 0.0;
}

}  // namespace

bool open_call(const Ready& law, const State& old, const Strain& d, Task& task) {
    *task.update = {old, Outcome::done, {}};
    State& state = task.update->state;
    task.plastic = d;
    // At the floor p_min, dilation does not change the stress.
    if (old.on_floor && trace(d) < 0.0) return false;
    state.on_floor = false;
    const ElasticPath path(law, old, d, Cap::shrinks);
    ++task.update->counts.evaluations;
    double F = path.excess(old);
    if (F >= -near_surface) return true;
    if (law.parameters.unloading == Unloading::capped) {
        const State capped = path.at(0.0);
        F = path.excess(capped);
        if (F >= -near_surface) {
            state.p_i = std::max(capped.p_i, size_through(law, old));
            return true;
        }
    }
    const State end = path.at(1.0);
    const double F_end = path.excess(end);
    if (F_end <= found_surface) {
        state = end;
        state.on_floor = false;
        return false;
    }
    const double elastic = crossing(path, 0.0, F, 1.0, F_end);
    state = path.at(elastic);
    state.on_floor = false;
    task.plastic = (1.0 - elastic) * d;
    return elastic < 1.0;
}

double unload(const Ready& law, const Strain& rest, State& state) {
    const State from = state;
    const ElasticPath path(law, from, rest, Cap::follows);
    const double F_end = path.excess(1.0);
    if (F_end <= found_surface) {
        state = path.at(1.0);
        return 1.0;
    }
    for (double inside = 0.5; inside > 1e-9; inside *= 0.5) {
        const double F = path.excess(inside);
        if (F >= -found_surface) continue;
        const double there = crossing(path, inside, F, 1.0, F_end);
        state = path.at(there);
        return there;
    }
    return 0.0;
}

void finish_call(const Ready& law, const State& old, const Strain& d, Task& task) {
    Update& update = *task.update;
    State& state = update.state;
    if (update.outcome == Outcome::unresolved && norm(d) <= least_followed) {
        state = old;
        fall(law, state);
        state.has_fallen = true;
        state.sub_step = least_guess;
        ++update.counts.guarded;
        update.outcome = Outcome::done;
    }
    if (update.outcome == Outcome::done) {
        state.e = (1.0 + old.e) * std::exp(-trace(d)) - 1.0;
        if (state.on_floor || trace(stress_of(state)) < 3.0 * law.parameters.p_min) {
            hold_at_floor(law, state);
            ++update.counts.floored;
        }
        if (cut_off_tension(state)) ++update.counts.cut_off;
        if (is_finite(state)) return;
        update.outcome = Outcome::unresolved;
    }
    state = old;
}

}  // namespace breach::materials::norsand
