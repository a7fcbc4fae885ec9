#include "core/statistics/neighbours.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace breach::statistics {

namespace {

/// Squared deviation of a sample from the line through its neighbours, divided by its expectation
/// for variance 1.
double variance_at(const CurvePoint& before, const CurvePoint& here, const CurvePoint& after) {
    const double a = (after.x - here.x) / (after.x - before.x);
    const double b = 1.0 - a;
    const double deviation = a * before.y + b * after.y - here.y;
    return deviation * deviation / (a * a + b * b + 1.0);
}

}  // namespace

std::vector<std::optional<double>> scatter_among_neighbours(std::span<const CurvePoint> samples) {
    constexpr std::size_t least = 3;
    const std::size_t n = samples.size();
    std::vector<std::optional<double>> scatter(n);
    if (n < least + 2) return scatter;
    std::vector<double> variances;  // of samples 1 to n - 2
    for (std::size_t i = 1; i + 1 < n; ++i)
        variances.push_back(variance_at(samples[i - 1], samples[i], samples[i + 1]));
    for (std::size_t i = 0; i < n; ++i) {
        // At the ends: the nearest ones.
        const std::size_t middle = std::clamp<std::size_t>(i, 1, n - 2) - 1;
        const std::size_t from = middle - std::min<std::size_t>(middle, neighbours_each_side);
        const std::size_t to = std::min(middle + neighbours_each_side + 1, variances.size());
        if (to - from < least) continue;
        double sum = 0.0;
        for (std::size_t k = from; k < to; ++k) sum += variances[k];
        scatter[i] = std::sqrt(sum / static_cast<double>(to - from));
    }
    return scatter;
}

}  // namespace breach::statistics
