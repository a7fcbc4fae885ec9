#include "core/statistics/repeats.hpp"

#include <cassert>
#include <cmath>
#include <numbers>

namespace breach::statistics {

Repeats repeats_of(std::span<const double> values) {
    assert(!values.empty());
    Repeats repeats{.mean = 0.0, .deviation = std::nullopt, .count = values.size()};
    const auto n = static_cast<double>(values.size());
    for (const double each : values) repeats.mean += each / n;
    if (values.size() < 2) return repeats;
    double squares = 0.0;
    for (const double each : values) squares += (each - repeats.mean) * (each - repeats.mean);
    repeats.deviation = std::sqrt(squares / (n - 1.0));
    return repeats;
}

std::optional<Noise> pooled_noise(std::span<const Repeats> settings) {
    double squares = 0.0;
    std::size_t freedom = 0;
    for (const Repeats& each : settings) {
        if (!each.deviation) continue;
        squares += static_cast<double>(each.count - 1) * *each.deviation * *each.deviation;
        freedom += each.count - 1;
    }
    if (freedom == 0) return std::nullopt;
    return Noise{std::sqrt(squares / static_cast<double>(freedom)), freedom};
}

namespace {

/// Probability that |T| <= t: finite sums over powers of cos^2 of the angle atan(t / sqrt(freedom)).
double share_within(double t, std::size_t freedom) {
    const auto nu = static_cast<double>(freedom);
    const double angle = std::atan(t / std::sqrt(nu));
    const double cosine = std::cos(angle);
    const bool odd = freedom % 2 == 1;
    double term = odd ? cosine : 1.0;
    double sum = freedom == 1 ? 0.0 : term;
    for (double k = odd ? 3.0 : 2.0; k < nu - 1.0; k += 2.0) {
        term *= cosine * cosine * (k - 1.0) / k;
        sum += term;
    }
    if (!odd) return std::sin(angle) * sum;
    return 2.0 / std::numbers::pi * (angle + std::sin(angle) * sum);
}

}  // namespace

double student_factor(double share, std::size_t freedom) {
    assert(share > 0.0 && share < 1.0 && freedom > 0);
    double low = 0.0;
    double high = 1.0;
    while (share_within(high, freedom) < share) high *= 2.0;
    for (;;) {
        const double middle = 0.5 * (low + high);
        if (middle <= low || middle >= high) return middle;
        (share_within(middle, freedom) < share ? low : high) = middle;
    }
}

double half_width_of_mean(const Noise& noise, std::size_t count) {
    return student_factor(confidence, noise.freedom) * noise.deviation /
           std::sqrt(static_cast<double>(count));
}

std::optional<double> half_width_of_mean(const Repeats& repeats) {
    if (!repeats.deviation) return std::nullopt;
    return half_width_of_mean(Noise{*repeats.deviation, repeats.count - 1}, repeats.count);
}

}  // namespace breach::statistics
