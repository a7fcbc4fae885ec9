#include "core/statistics/mean_of_draws.hpp"

#include <cmath>

#include "core/statistics/quantiles.hpp"

namespace breach::statistics {

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
