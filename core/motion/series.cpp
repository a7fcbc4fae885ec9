#include "core/motion/series.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace breach::motion {

double Series::duration() const {
    return values.empty() ? 0.0 : dt * static_cast<double>(values.size() - 1);
}

double value_at(const Series& series, double t) {
    const double place = t / series.dt;
    const double last = static_cast<double>(series.values.size()) - 1.0;
    constexpr double rounding = 1e-9;  // round-off of a clock after many steps
    if (series.values.empty() || place < -rounding || place > last + rounding) return 0.0;
    const double low = std::clamp(std::floor(place), 0.0, std::max(0.0, last - 1.0));
    const auto i = static_cast<std::size_t>(low);
    if (i + 1 >= series.values.size()) return series.values[i];
    const double share = std::clamp(place - low, 0.0, 1.0);
    return (1.0 - share) * series.values[i] + share * series.values[i + 1];
}

double peak(const Series& series) {
    double largest = 0.0;
    for (const double value : series.values) largest = std::max(largest, std::abs(value));
    return largest;
}

Series scaled_to_peak(Series series, double wanted) {
    const double now = peak(series);
    if (now == 0.0) return series;
    for (double& value : series.values) value *= wanted / now;
    return series;
}

Series integral(const Series& series) {
    Series result{series.dt, std::vector<double>(series.values.size(), 0.0)};
    for (std::size_t i = 1; i < series.values.size(); ++i) {
        const double mean = 0.5 * (series.values[i - 1] + series.values[i]);
        result.values[i] = result.values[i - 1] + series.dt * mean;
    }
    return result;
}

Series derivative(const Series& series) {
    Series result{series.dt, std::vector<double>(series.values.size(), 0.0)};
    const std::size_t n = series.values.size();
    for (std::size_t i = 0; n > 1 && i < n; ++i) {
        const std::size_t before = i == 0 ? 0 : i - 1, after = std::min(i + 1, n - 1);
        result.values[i] = (series.values[after] - series.values[before]) /
                           (series.dt * static_cast<double>(after - before));
    }
    return result;
}

Series equally_spaced(const std::vector<double>& times, const std::vector<double>& values,
                      double dt) {
    Series result{dt, {}};
    if (times.empty()) return result;
    std::size_t next = 0;
    for (double t = 0.0; t <= times.back() + 1e-9 * dt; t = dt * double(result.values.size())) {
        while (next + 1 < times.size() && times[next] < t) ++next;
        if (next == 0 || times[next] <= t) {
            result.values.push_back(values[next]);
            continue;
        }
        const double share = (t - times[next - 1]) / (times[next] - times[next - 1]);
        result.values.push_back((1.0 - share) * values[next - 1] + share * values[next]);
    }
    return result;
}

namespace {

/// Cumulative Arias intensity at each sample [m/s].
Series arrived(const Series& acceleration) {
    Series square = acceleration;
    constexpr double factor = 0.5 * std::numbers::pi / standard_gravity;
    for (double& value : square.values) value *= factor * value;
    return integral(square);
}

double time_of(const Series& rising, double level) {
    const auto above = std::ranges::lower_bound(rising.values, level);
    const auto i = static_cast<std::size_t>(above - rising.values.begin());
    if (i == 0 || i >= rising.values.size()) return rising.dt * static_cast<double>(i);
    const double low = rising.values[i - 1], high = rising.values[i];
    return rising.dt * (static_cast<double>(i) - (high - level) / (high - low));
}

}  // namespace

double arias_intensity(const Series& acceleration) {
    const Series sum = arrived(acceleration);
    return sum.values.empty() ? 0.0 : sum.values.back();
}

StrongPart strong_part(const Series& acceleration) {
    const Series sum = arrived(acceleration);
    if (sum.values.empty() || sum.values.back() == 0.0) return {0.0, 0.0};
    const double all = sum.values.back();
    return {time_of(sum, 0.05 * all), time_of(sum, 0.95 * all)};
}

Band band(const Series& motion) {
    const double spacing = std::max(0.05, 0.5 / std::max(motion.duration(), motion.dt));
    const double last = std::min(50.0, 0.5 / motion.dt);
    Series power{spacing, {0.0}};
    for (double f = spacing; f <= last; f += spacing) {
        const std::complex<double> turn = std::polar(1.0, -2.0 * std::numbers::pi * f * motion.dt);
        std::complex<double> phase = 1.0, sum = 0.0;
        for (const double value : motion.values) {
            sum += value * phase;
            phase *= turn;
        }
        power.values.push_back(power.values.back() + std::norm(sum));
    }
    const double all = power.values.back();
    return {time_of(power, 0.02 * all), time_of(power, 0.98 * all)};
}

Baseline baseline(const Series& acceleration) {
    const Series velocity = integral(acceleration);
    const Series displacement = integral(velocity);
    if (velocity.values.empty()) return {0.0, 0.0, 0.0};
    const double last = velocity.values.back(), largest = peak(velocity);
    return {last, displacement.values.back(), largest > 0.0 ? std::abs(last) / largest : 0.0};
}

Series base_corrected(Series acceleration) {
    const std::size_t count = acceleration.values.size();
    if (count < 3) return acceleration;
    const Baseline left = baseline(acceleration);
    // Final velocity and displacement of a = 1 and a = t with the same integration rule.
    Series constant{acceleration.dt, std::vector<double>(count, 1.0)}, ramp = constant;
    for (std::size_t i = 0; i < count; ++i) {
        ramp.values[i] = acceleration.dt * static_cast<double>(i);
    }
    const Baseline one = baseline(constant), t = baseline(ramp);
    const double determinant =
        one.last_velocity * t.last_displacement - t.last_velocity * one.last_displacement;
    const double c_0 =
        (left.last_velocity * t.last_displacement - t.last_velocity * left.last_displacement) /
        determinant;
    const double c_1 =
        (one.last_velocity * left.last_displacement - left.last_velocity * one.last_displacement) /
        determinant;
    for (std::size_t i = 0; i < count; ++i) {
        acceleration.values[i] -= c_0 + c_1 * ramp.values[i];
    }
    return acceleration;
}

}  // namespace breach::motion
