#include "core/statistics/distribution.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/statistics/quantiles.hpp"
#include "core/words/number.hpp"

namespace breach::statistics {

namespace {

/// Standard deviation of the logarithm.
double lognormal_deviation(double cov) { return std::sqrt(std::log1p(cov * cov)); }

/// Quantile without `between`.
double whole_quantile(const Distribution& distribution, double u) {
    const auto [a, b, c] = distribution.numbers;
    switch (distribution.kind) {
        case DistributionKind::uniform:
            return a + u * (b - a);
        case DistributionKind::log_uniform:
            return a * std::pow(b / a, u);
        case DistributionKind::normal:
            return a + b * normal_quantile(u);
        case DistributionKind::lognormal:
            return a * std::exp(lognormal_deviation(b) * normal_quantile(u));
        case DistributionKind::triangular:
            break;
    }
    const double rising = (b - a) / (c - a);
    if (u < rising) return a + std::sqrt(u * (c - a) * (b - a));
    return c - std::sqrt((1.0 - u) * (c - a) * (c - b));
}

/// Standard deviations of x above the median (normal, lognormal).
double deviations(const Distribution& distribution, double x) {
    const auto [a, b, c] = distribution.numbers;
    if (distribution.kind == DistributionKind::normal) return (x - a) / b;
    return x > 0.0 ? std::log(x / a) / lognormal_deviation(b) : -HUGE_VAL;
}

bool is_of_normal(DistributionKind kind) {
    return kind == DistributionKind::normal || kind == DistributionKind::lognormal;
}

}  // namespace

double share_below(const Distribution& distribution, double x) {
    const auto [a, b, c] = distribution.numbers;
    switch (distribution.kind) {
        case DistributionKind::uniform:
            return std::clamp((x - a) / (b - a), 0.0, 1.0);
        case DistributionKind::log_uniform:
            return x <= a ? 0.0 : std::min(1.0, std::log(x / a) / std::log(b / a));
        case DistributionKind::normal:
        case DistributionKind::lognormal:
            return normal_cdf(deviations(distribution, x));
        case DistributionKind::triangular:
            break;
    }
    if (x <= a) return 0.0;
    if (x >= c) return 1.0;
    if (x < b) return (x - a) * (x - a) / ((c - a) * (b - a));
    return 1.0 - (c - x) * (c - x) / ((c - a) * (c - b));
}

double share_between(const Distribution& distribution) {
    if (!distribution.between) return 1.0;
    const auto [low, high] = *distribution.between;
    // In the upper half the probabilities are near 1 and their difference loses digits: use those
    // above.
    if (is_of_normal(distribution.kind) && deviations(distribution, low) > 0.0)
        return normal_cdf(-deviations(distribution, low)) -
               normal_cdf(-deviations(distribution, high));
    return share_below(distribution, high) - share_below(distribution, low);
}

double quantile(const Distribution& distribution, double u) {
    if (!distribution.between) return whole_quantile(distribution, u);
    const auto [low, high] = *distribution.between;
    const double share = share_between(distribution);
    double value = 0.0;
    if (is_of_normal(distribution.kind) && deviations(distribution, low) > 0.0) {
        const double above = normal_cdf(-deviations(distribution, high)) + (1.0 - u) * share;
        const double z = -normal_quantile(above);
        const auto [a, b, c] = distribution.numbers;
        value = distribution.kind == DistributionKind::normal
                    ? a + b * z
                    : a * std::exp(lognormal_deviation(b) * z);
    } else {
        value = whole_quantile(distribution, share_below(distribution, low) + u * share);
    }
    return std::clamp(value, low, high);  // round-off
}

double in_six_digits(double value) { return std::strtod(words::text_of(value).c_str(), nullptr); }

}  // namespace breach::statistics
