#include "lem_tool/hypercube.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace breach::lem {

namespace {

/// SplitMix64 (Steele, Lea & Flood 2014).
class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed) {}
    std::uint64_t next() {
        state_ += 0x9e3779b97f4a7c15u;
        std::uint64_t z = state_;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }
    /// In (0, 1).
    double share() { return (static_cast<double>(next() >> 11) + 0.5) * 0x1p-53; }

  private:
    std::uint64_t state_;
};

}  // namespace

double standard_normal_quantile(double probability) {
    double low = -40.0;
    double high = 40.0;
    while (high - low > 1e-14 * std::max(1.0, std::abs(low))) {
        const double z = 0.5 * (low + high);
        if (z == low || z == high) break;
        (0.5 * std::erfc(-z / std::sqrt(2.0)) < probability ? low : high) = z;
    }
    return 0.5 * (low + high);
}

std::vector<double> hypercube_column(std::size_t count, std::uint64_t seed, std::size_t column) {
    Random seeds(seed);
    for (std::size_t n = 0; n < column; ++n) seeds.next();
    Random random(seeds.next());
    std::vector<std::size_t> interval(count);
    std::iota(interval.begin(), interval.end(), std::size_t{0});
    for (std::size_t i = count; i > 1; --i) {
        std::swap(interval[i - 1], interval[random.next() % i]);
    }
    std::vector<double> column_values(count);
    for (std::size_t i = 0; i < count; ++i) {
        column_values[i] =
            (static_cast<double>(interval[i]) + random.share()) / static_cast<double>(count);
    }
    return column_values;
}

double factor_at(const scene::RandomVariable& variable, double probability) {
    const double z = standard_normal_quantile(probability);
    if (variable.distribution == scene::Distribution::normal) {
        return std::max(0.0, 1.0 + variable.variation * z);
    }
    const double variance = std::log(1.0 + variable.variation * variable.variation);
    return std::exp(std::sqrt(variance) * z - 0.5 * variance);
}

}  // namespace breach::lem
