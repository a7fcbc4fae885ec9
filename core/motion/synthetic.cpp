#include "core/motion/synthetic.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "core/fault/fault.hpp"

namespace breach::motion {
namespace {

using std::numbers::pi;

constexpr int harmonics = 400;
constexpr double accepted = 0.01;  // relative error of each target

/// Varied quantities; the search changes their logarithms.
struct Shape {
    double frequency = 1.5;   ///< of the ground filter [Hz]
    double duration = 10.0;   ///< constant part of the envelope [s]
    double peakedness = 1.0;  ///< exponent m [-]
};

/// Uniform in [0, 1) from raw bits: std::uniform_real_distribution differs between libraries.
double uniform(std::mt19937_64& bits) { return static_cast<double>(bits() >> 11) * 0x1p-53; }

double envelope(double t, double hold) {
    const double rise = 0.15 * hold;
    if (t < rise) return (t / rise) * (t / rise);
    if (t < rise + hold) return 1.0;
    return std::exp(-3.0 * (t - rise - hold) / hold);
}

/// Amplitude of ground acceleration at the frequency ratio r = f / f_g with 60 % damping, without
/// low frequencies (r << 1), which would only drift.
double amplitude(double r) {
    constexpr double zeta = 0.6;
    const double low_cut = std::pow(r, 4) / (std::pow(r, 4) + std::pow(0.15, 4));
    const double square = (2.0 * zeta * r) * (2.0 * zeta * r);
    return low_cut * std::sqrt((1.0 + square) / ((1.0 - r * r) * (1.0 - r * r) + square));
}

/// Stationary noise times its envelope, with unit peak. Frequencies are spaced geometrically from
/// 0.1 to 8 times the filter's, so that another filter frequency only scales time.
Series noise(const Target& target, const Shape& shape, std::uint64_t seed) {
    std::mt19937_64 bits(seed);
    const auto count = static_cast<std::size_t>(std::llround(target.length / target.dt)) + 1;
    Series series{target.dt, std::vector<double>(count, 0.0)};
    const double ratio = std::pow(80.0, 1.0 / harmonics);
    double r = 0.1;
    for (int k = 0; k < harmonics; ++k, r *= ratio) {
        const double phase = 2.0 * pi * uniform(bits);
        const double place = r * std::pow(ratio, uniform(bits));
        const double a = amplitude(place) * std::sqrt(place * (ratio - 1.0));
        const double omega = 2.0 * pi * place * shape.frequency;
        if (omega * target.dt > 0.8 * pi) continue;  // aliased
        for (std::size_t i = 0; i < count; ++i) {
            series.values[i] += a * std::cos(omega * target.dt * static_cast<double>(i) + phase);
        }
    }
    for (std::size_t i = 0; i < count; ++i) {
        series.values[i] *= envelope(target.dt * static_cast<double>(i), shape.duration);
    }
    return scaled_to_peak(std::move(series), 1.0);
}

Series shaped(Series unit, double peakedness, const Target& target) {
    for (double& value : unit.values) {
        value = std::copysign(std::pow(std::abs(value), peakedness), value);
    }
    return scaled_to_peak(base_corrected(std::move(unit)), target.peak_acceleration);
}

/// Obtained over target: peak velocity, strong duration, Arias intensity.
std::array<double, 3> ratios(const Series& a, const Target& target) {
    return {peak(integral(a)) / target.peak_velocity,
            strong_part(a).duration() / target.strong_duration,
            arias_intensity(a) / target.arias_intensity};
}

double worst(const std::array<double, 3>& ratio) {
    double largest = 0.0;
    for (const double each : ratio) largest = std::max(largest, std::abs(each - 1.0));
    return largest;
}

/// The exponent m that gives the target Arias intensity at the target peak; a larger m lowers it.
double fitting_peakedness(const Series& unit, const Target& target) {
    double low = 0.3, high = 4.0;
    for (int halving = 0; halving < 24; ++halving) {
        const double middle = 0.5 * (low + high);
        const double reached = arias_intensity(shaped(unit, middle, target));
        (reached > target.arias_intensity ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

struct Attempt {
    Series motion;
    double error;  ///< largest relative error
};

/// Fixed-point search for one set of random phases. It may oscillate if the peak velocity moves to
/// another cycle.
Attempt search(const Target& target, std::uint64_t seed) {
    Shape shape;
    shape.duration = 0.8 * target.strong_duration;
    shape.frequency = target.peak_acceleration / (2.0 * pi * target.peak_velocity);
    Attempt attempt{{}, 1.0};
    for (int round = 0; round < 25; ++round) {
        const Series unit = noise(target, shape, seed);
        shape.peakedness = fitting_peakedness(unit, target);
        attempt.motion = shaped(unit, shape.peakedness, target);
        const auto [velocity, duration, arias] = ratios(attempt.motion, target);
        attempt.error = worst({velocity, duration, arias});
        if (attempt.error <= accepted) break;
        // Velocity is proportional to 1 / frequency. Half a step, as the peak may move to another
        // cycle.
        shape.frequency *= std::sqrt(velocity);
        shape.duration /= std::sqrt(duration);
    }
    return attempt;
}

}  // namespace

Series synthetic_motion(const Target& target) {
    constexpr std::uint64_t draws = 12, apart = 0x9e3779b97f4a7c15;
    double least = 1e300;
    for (std::uint64_t draw = 0; draw < draws; ++draw) {
        Attempt attempt = search(target, target.seed + draw * apart);
        if (attempt.error <= accepted) return std::move(attempt.motion);
        least = std::min(least, attempt.error);
    }
    throw fault::BadInput("synthetic motion",
                          {{"/target",
                            "peak values, duration and Arias intensity cannot be met together (" +
                                std::to_string(100.0 * least) + " % off)",
                            "bring them closer to a real record's, or try another seed"}});
}

}  // namespace breach::motion
