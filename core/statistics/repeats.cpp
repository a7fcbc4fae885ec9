#include "core/statistics/repeats.hpp"

#include <cassert>
#include <cmath>

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

double half_width_of_mean(const Noise& noise, std::size_t count) {
    return student_factor(confidence, noise.freedom) * noise.deviation /
           std::sqrt(static_cast<double>(count));
}

std::optional<double> half_width_of_mean(const Repeats& repeats) {
    if (!repeats.deviation) return std::nullopt;
    return half_width_of_mean(Noise{*repeats.deviation, repeats.count - 1}, repeats.count);
}

double promised_error(double bias, const Repeats& measured, double reference, std::size_t draws) {
    if (!measured.deviation) return bias;
    const double of_means =
        std::sqrt(1.0 / static_cast<double>(draws) + 1.0 / static_cast<double>(measured.count));
    const double factor = student_factor(confidence, measured.count - 1);
    return bias + factor * *measured.deviation * of_means / std::abs(reference);
}

std::optional<std::size_t> draws_within(double asked, double bias, const Repeats& measured,
                                        double reference) {
    for (std::size_t draws = 1; draws <= most_draws_of_a_mean; ++draws)
        if (promised_error(bias, measured, reference, draws) <= asked) return draws;
    return std::nullopt;
}

}  // namespace breach::statistics
