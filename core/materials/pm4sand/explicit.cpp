// Sections 13.2, 13.4 and 13.5 of docs/reference/methods/pm4sand_integration.md, exactly as in
// OpenSees.
#include "core/materials/pm4sand/explicit.hpp"

#include <algorithm>
#include <cmath>

namespace breach::materials::pm4sand {

namespace {

constexpr double part_size = 1e-5;        // largest strain component of one part
constexpr double least_time_step = 1e-4;  // of pseudo-time in a part
constexpr double error_tolerance = 1e-5;
constexpr int most_corrections = 25;

struct Increment {
    Stress sigma;
    Plane alpha, z;
};

class Part {
  public:
    Part(const Ready& law, const State& committed, const Options& options, Counts& counts)
        : law_(law),
          committed_(committed),
          options_(options),
          counts_(counts),
          fixed_(fixed_of<double>(committed)),
          M_b_(committed.M_b),
          M_d_(committed.M_b) {
        prepare(law_, fixed_);
        sigma = {committed.p, committed.s};
        alpha = committed.alpha;
        z = committed.z;
        epsilon_v = committed.epsilon_v;
    }

    /// Integrates one part d of the strain; false: evaluations used up.
    bool advance(const Strain<double>& d);

    Stress sigma;
    Plane alpha, z;
    double epsilon_v;
    double M_b() const { return M_b_; }

  private:
    struct Trial {
        Increment mean;
        double error;
        bool possible;  ///< false: the stress left the compressive side
    };
    Trial trial_step(const Strain<double>& d, double D);
    Increment rates(const Stress& at, const Plane& alpha_at, const Plane& z_at,
                    const Strain<double>& d, double D);
    void correct_drift(double D);
    void correct_low_pressure(double f);

    const Ready& law_;
    const State& committed_;
    const Options& options_;
    Counts& counts_;
    Fixed<double> fixed_;
    double M_b_, M_d_;
    double G_ = 0.0, M_cur_ = 0.0;  ///< at the start of the part
    double multiplier_ = 0.0;       ///< of the last second stage, for the drift correction
};

double size_of(const Stress& a) { return std::sqrt(2.0 * a.p * a.p + dot(a.s, a.s)); }

/// Rates of section 8 for the strain d.
Increment Part::rates(const Stress& at, const Plane& alpha_at, const Plane& z_at,
                      const Strain<double>& d, double D) {
    ++counts_.evaluations;
    const double G = G_;
    const double K = law_.K_over_G * G;
    const Point<double> point{at.p, alpha_at, normal(law_, at, alpha_at), z_at, G, M_cur_};
    const auto surface = surfaces(law_, std::max(at.p, fixed_.p_min), D);
    const auto flow = pm4sand::flow(law_, fixed_, point, surface);
    M_b_ = surface.M_b;
    M_d_ = surface.M_d;
    const double nr = dot(point.n, at.s) / at.p;
    const double Hd = flow.K_p + 2.0 * G - K * flow.D * nr;
    multiplier_ = 0.0;
    if (std::abs(Hd) < 1e-10 * law_.unit) return {};
    const double L = (2.0 * G * dot(point.n, d.e) - K * nr * d.v) / Hd;
    if (Hd < 0.0) ++counts_.softened;
    if (L < 0.0) {
        multiplier_ = L;
        return {elastic_change(law_, G, d), {}, {}};
    }
    multiplier_ = L;
    return {{(K + G / 3.0) * d.v - L * K * flow.D, 2.0 * G * (d.e - L * point.n)},
            (2.0 / 3.0) * L * flow.h * flow.b,
            fabric_rate(fixed_, point, flow, L)};
}

Part::Trial Part::trial_step(const Strain<double>& d, double D) {
    const Increment one = rates(sigma, alpha, z, d, D);
    const Stress there{sigma.p + one.sigma.p, sigma.s + one.sigma.s};
    if (there.p < 0.0) return {{}, 0.0, false};
    const Increment two = rates(there, alpha + one.alpha, z + one.z, d, D);
    const Increment mean{{0.5 * (one.sigma.p + two.sigma.p), 0.5 * (one.sigma.s + two.sigma.s)},
                         0.5 * (one.alpha + two.alpha),
                         0.5 * (one.z + two.z)};
    if (sigma.p + mean.sigma.p < 0.0) return {{}, 0.0, false};
    const double gap = size_of({two.sigma.p - one.sigma.p, two.sigma.s - one.sigma.s});
    const double scale = size_of(sigma);
    const double error = scale < 0.5 * law_.unit ? gap / law_.unit : gap / (2.0 * scale);
    return {mean, error, true};
}

bool Part::advance(const Strain<double>& d) {
    M_cur_ = stress_ratio(sigma.p, sigma.s, fixed_.p_min);
    G_ = shear_modulus(law_, fixed_, sigma.p, M_cur_, M_b_, M_d_);
    sigma.p = std::max(sigma.p, fixed_.p_min / 5.0);
    const Stress start = sigma;
    const Plane start_alpha = alpha;
    const Plane start_z = z;
    const int most = counts_.evaluations + options_.most_evaluations;
    double T = 0.0, dT = 1.0;
    while (T < 1.0) {
        if (counts_.evaluations > most) return false;
        const double D = density(law_, epsilon_v + T * d.v);
        const Trial trial = trial_step({dT * d.v, dT * d.e}, D);
        const double growth = 0.8 * std::sqrt(error_tolerance / std::max(trial.error, 1e-300));
        if (!trial.possible) {
            if (dT <= least_time_step) {  // accepts this part without message, as OpenSees
                sigma = start;
                alpha = start_alpha;
                z = start_z;
                ++counts_.forced;
                break;
            }
            dT = std::max(0.1 * dT, least_time_step);
            ++counts_.rejected;
            continue;
        }
        const bool exact = trial.error <= error_tolerance;
        if (!exact && dT > least_time_step) {
            dT = std::max(dT * std::max(growth, 0.1), least_time_step);
            ++counts_.rejected;
            continue;
        }
        sigma = {sigma.p + trial.mean.sigma.p, sigma.s + trial.mean.sigma.s};
        alpha = alpha + trial.mean.alpha;
        if (exact) z = z + trial.mean.z;
        correct_drift(D);
        T += dT;
        ++counts_.sub_steps;
        if (exact) {
            dT = std::max(std::max(growth, 0.5) * dT, least_time_step);
        } else {
            ++counts_.forced;
        }
        dT = std::min(dT, 1.0 - T);
    }
    epsilon_v += d.v;
    return true;
}

/// Departs from: OpenSees, which sets a positive shear far outside the surfaces; here the direction
/// stays (section 13.4). Rarely used.
void Part::correct_low_pressure(double f) {
    const double least = fixed_.p_min / 5.0;
    if (f < 1e-8 * law_.unit) {
        sigma.p = least;
        return;
    }
    const double size = norm(sigma.s);
    const double reach = M_b_ * inverse_sqrt2;
    const double ratio = std::min(size / least, reach);
    const Plane r = size > 0.0 ? (ratio / size) * sigma.s : Plane{0.0, 0.0};
    sigma = {least, least * r};
    alpha = ((M_b_ - law_.parameters.m) / M_b_) * r;
}

void Part::correct_drift(double D) {
    const double tolerance = 1e-8 * law_.unit;
    double f = yield_function(law_, sigma, alpha);
    if (sigma.p < fixed_.p_min / 5.0) return correct_low_pressure(f);
    const double G = committed_.G;
    const double K = law_.K_over_G * G;
    for (int pass = 0; pass < most_corrections && f >= tolerance; ++pass) {
        ++counts_.evaluations;
        const double p_hat = std::max(sigma.p, fixed_.p_min);
        const Point<double> point{sigma.p, alpha, normal(law_, sigma, alpha), z, G, M_cur_};
        const auto surface = surfaces(law_, p_hat, D);
        const auto flow = pm4sand::flow(law_, fixed_, point, surface);
        M_b_ = surface.M_b;
        M_d_ = surface.M_d;
        const double nr = dot(point.n, sigma.s) / sigma.p;
        // A = n - (n:r) m / 2; P = dGamma C_e (n + D/3 m), which contains the multiplier as in
        // OpenSees.
        const double P_m = multiplier_ * flow.D * (2.0 / 3.0 * K + 2.0 / 9.0 * G);
        const Plane P_n = (multiplier_ * 2.0 * G) * point.n;
        const Plane a_bar = (2.0 / 3.0) * flow.h * flow.b;
        const double lambda = f / (dot(point.n, P_n) - nr * P_m + p_hat * dot(point.n, a_bar));
        const Stress shifted{sigma.p - lambda * P_m, sigma.s - lambda * P_n};
        const Plane alpha_shifted = alpha + lambda * a_bar;
        if (std::abs(yield_function(law_, shifted, alpha_shifted)) < std::abs(f)) {
            sigma = shifted;
            alpha = alpha_shifted;
        } else {
            const double scale = f / (1.0 + 0.5 * nr * nr);
            sigma = {sigma.p + 0.5 * nr * scale, sigma.s - scale * point.n};
        }
        f = yield_function(law_, sigma, alpha);
        if (f >= tolerance) sigma.p = std::max(sigma.p, fixed_.p_min);
    }
}

/// Section 11, once per call, with the normal at the end of the elastic path.
void detect_reversal(const Ready& law, const Strain<double>& d, State& state) {
    const Stress change = elastic_change(law, state.G, d);
    const Plane n = normal(law, {state.p + change.p, state.s + change.s}, state.alpha);
    if (dot(state.alpha - state.alpha_true, n) < 0.0) reverse(n, state);
}

}  // namespace

Update integrate_reference(const Ready& law, const State& old, const Strain<double>& d,
                           const Options& options) {
    Update update{old, Outcome::done, {}};
    State& state = update.state;
    detect_reversal(law, d, state);
    const Stress change = elastic_change(law, state.G, d);
    const double a = elastic_fraction(law, {state.p, state.s}, state.alpha, change);
    Part part(law, state, options, update.counts);
    part.sigma = {state.p + a * change.p, state.s + a * change.s};
    part.epsilon_v += a * d.v;
    if (a < 1.0) {
        const Strain<double> rest{(1.0 - a) * d.v, (1.0 - a) * d.e};
        const double largest = largest_component(rest);
        // More parts than an int holds: unresolved.
        if (largest > 1e3) return {old, Outcome::unresolved, update.counts};
        const int parts = largest > part_size ? static_cast<int>(largest / part_size) + 1 : 1;
        const Strain<double> each{rest.v / parts, (1.0 / parts) * rest.e};
        for (int i = 0; i < parts; ++i) {
            if (!part.advance(each)) return {old, Outcome::unresolved, update.counts};
        }
    }
    state.p = part.sigma.p;
    state.s = part.sigma.s;
    state.alpha = part.alpha;
    state.M_b = part.M_b();
    state.epsilon_v = old.epsilon_v + d.v;
    close_call(law, part.z, state, update.counts);
    if (!is_finite(state)) return {old, Outcome::unresolved, update.counts};
    return update;
}

}  // namespace breach::materials::pm4sand
