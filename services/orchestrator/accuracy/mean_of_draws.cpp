#include "services/orchestrator/accuracy/mean_of_draws.hpp"

#include <cassert>
#include <cmath>
#include <numbers>

namespace breach::orchestrator {

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

}  // namespace breach::orchestrator
