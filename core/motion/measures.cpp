#include "core/motion/measures.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

namespace breach::motion {

namespace {

const std::vector<double> periods{0.01, 0.02, 0.03, 0.05, 0.075, 0.1, 0.15, 0.2, 0.25, 0.3,
                                  0.4,  0.5,  0.6,  0.75, 1.0,   1.5, 2.0,  3.0, 4.0,  5.0};

/// Evaluations of the response per period, at least.
constexpr double looks_per_period = 40.0;

/// u'' + 2 xi omega u' + omega^2 u = -a over one step from u and v; a is linear from a_0 with
/// `slope`.
struct Oscillator {
    double omega, damping;
    double u = 0.0, v = 0.0;

    void step(double a_0, double slope, double dt) {
        const double w2 = omega * omega, xi = damping;
        const double w_d = omega * std::sqrt(1.0 - xi * xi);
        // particular solution: u_p = A + B t
        const double B = -slope / w2;
        const double A = -a_0 / w2 + 2.0 * xi * slope / (omega * w2);
        const double c = u - A;
        const double s = (v - B + xi * omega * c) / w_d;
        const double decay = std::exp(-xi * omega * dt);
        const double cosine = std::cos(w_d * dt), sine = std::sin(w_d * dt);
        u = A + B * dt + decay * (c * cosine + s * sine);
        v = B + decay * ((s * w_d - xi * omega * c) * cosine - (c * w_d + xi * omega * s) * sine);
    }
};

double whole_integral(const Series& series) {
    return series.values.empty() ? 0.0 : integral(series).values.back();
}

double masi_of(const Series& acceleration) {
    constexpr double first = 0.1, step = 0.02;
    constexpr int count = 96;  // to 2 s
    Series over_period{step, {}};
    for (int i = 0; i < count; ++i)
        over_period.values.push_back(spectral_acceleration(acceleration, first + step * i));
    return whole_integral(over_period);
}

double cav_of(Series acceleration) {
    for (double& value : acceleration.values) value = std::abs(value);
    return whole_integral(acceleration);
}

}  // namespace

double spectral_acceleration(const Series& acceleration, double period, double damping) {
    const double omega = 2.0 * std::numbers::pi / period;
    const double cuts = std::ceil(std::max(1.0, acceleration.dt * looks_per_period / period));
    const double dt = acceleration.dt / cuts;
    Oscillator oscillator{omega, damping};
    double largest = 0.0;
    for (std::size_t i = 1; i < acceleration.values.size(); ++i) {
        const double slope =
            (acceleration.values[i] - acceleration.values[i - 1]) / acceleration.dt;
        for (double k = 0.0; k < cuts; k += 1.0) {
            oscillator.step(acceleration.values[i - 1] + slope * k * dt, slope, dt);
            largest = std::max(largest, std::abs(oscillator.u));
        }
    }
    return omega * omega * largest;
}

Measures measures_of(const Series& acceleration) {
    Measures all{.pga = peak(acceleration),
                 .pgv = peak(integral(acceleration)),
                 .pgd = peak(integral(integral(base_corrected(acceleration)))),
                 .arias = arias_intensity(acceleration),
                 .strong = strong_part(acceleration),
                 .cav = cav_of(acceleration),
                 .masi = masi_of(acceleration),
                 .periods = periods,
                 .spectrum = {}};
    for (const double period : periods)
        all.spectrum.push_back(spectral_acceleration(acceleration, period));
    return all;
}

nlohmann::json as_json(const Measures& all) {
    return {{"pga_g", all.pga / standard_gravity},
            {"pgv", all.pgv},
            {"pgd", all.pgd},
            {"arias", all.arias},
            {"strong_from", all.strong.begin},
            {"strong_duration", all.strong.duration()},
            {"cav", all.cav},
            {"masi", all.masi},
            {"spectrum", {{"period", all.periods}, {"acceleration", all.spectrum}}}};
}

}  // namespace breach::motion
