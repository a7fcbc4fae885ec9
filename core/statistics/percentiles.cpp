#include "core/statistics/percentiles.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace breach::statistics {

namespace {

constexpr double tail = 0.5 * (1.0 - confidence);

std::vector<double> in_order(std::span<const double> values) {
    std::vector<double> sorted(values.begin(), values.end());
    std::ranges::sort(sorted);
    return sorted;
}

/// Linear between neighbours; rank from 1 to the number of values.
double order_statistic(const std::vector<double>& sorted, double rank) {
    const double place = std::clamp(rank, 1.0, static_cast<double>(sorted.size())) - 1.0;
    const auto below = static_cast<std::size_t>(place);
    const double rest = place - static_cast<double>(below);
    if (rest == 0.0) return sorted[below];
    return sorted[below] + rest * (sorted[below + 1] - sorted[below]);
}

/// The rank r whose order statistic is at most the percentile with this probability. For uniform
/// numbers it is a beta variable: I_p(r, n + 1 - r).
double rank_below(double share, std::size_t n, double probability) {
    double low = 0.0;
    double high = static_cast<double>(n) + 1.0;
    for (int halving = 0; halving < 60; ++halving) {
        const double rank = 0.5 * (low + high);
        const bool too_often =
            incomplete_beta(rank, static_cast<double>(n) + 1.0 - rank, share) > probability;
        (too_often ? low : high) = rank;
    }
    return 0.5 * (low + high);
}

/// Wilson's interval of k / n: the probabilities that a normal test does not reject.
Interval wilson(double k, double n) {
    constexpr double z = normal_quantile_of_95;
    const double share = k / n;
    const double spread = 1.0 + z * z / n;
    const double centre = (share + z * z / (2.0 * n)) / spread;
    const double half = z / spread * std::sqrt(share * (1.0 - share) / n + z * z / (4.0 * n * n));
    return {share, std::clamp(centre - half, 0.0, share), std::clamp(centre + half, share, 1.0)};
}

std::string ordinal(long number) {
    const bool teen = number / 10 % 10 == 1;
    const long last = teen ? 0 : number % 10;
    const char* ending = last == 1 ? "st" : last == 2 ? "nd" : last == 3 ? "rd" : "th";
    return std::to_string(number) + ending;
}

}  // namespace

std::size_t samples_needed(double p) {
    assert(p > 0.0 && p < 100.0);
    return static_cast<std::size_t>(
        std::ceil(std::log(tail) / std::log(std::max(p, 100.0 - p) / 100.0)));
}

std::string not_enough(std::size_t samples, double p) {
    return std::to_string(samples) + (samples == 1 ? " sample is" : " samples are") +
           " not enough for the " + ordinal(std::lround(p)) +
           " percentile: " + std::to_string(samples_needed(p)) + " are needed";
}

Interval percentile(std::span<const double> values, double p) {
    assert(values.size() >= samples_needed(p));
    const std::vector<double> sorted = in_order(values);
    const std::size_t n = sorted.size();
    const double share = p / 100.0;
    return {order_statistic(sorted, 1.0 + static_cast<double>(n - 1) * share),
            order_statistic(sorted, rank_below(share, n, 1.0 - tail)),
            order_statistic(sorted, rank_below(share, n, tail))};
}

Interval share_below(std::span<const double> values, double limit) {
    assert(!values.empty());
    const auto below = std::ranges::count_if(values, [limit](double each) { return each < limit; });
    return wilson(static_cast<double>(below), static_cast<double>(values.size()));
}

std::vector<Exceedance> exceedance(std::span<const double> values) {
    const std::vector<double> sorted = in_order(values);
    const std::size_t n = sorted.size();
    const std::size_t points = std::min(n, most_points);
    std::vector<Exceedance> curve;
    for (std::size_t j = 0; j < points; ++j) {
        const double value = sorted[points < 2 ? 0 : j * (n - 1) / (points - 1)];
        if (!curve.empty() && curve.back().value == value) continue;
        const auto above = sorted.end() - std::ranges::upper_bound(sorted, value);
        curve.push_back({value, wilson(static_cast<double>(above), static_cast<double>(n))});
    }
    return curve;
}

}  // namespace breach::statistics
