#include "core/statistics/incomplete_beta.hpp"

#include <cassert>
#include <cmath>

namespace breach::statistics {

namespace {

/// 1 / (1 + d_1 / (1 + d_2 / (1 + ...))) by its convergents, each scaled so that none overflows.
double fraction(double a, double b, double x) {
    double numerator_before = 0.0, numerator = 1.0;
    double denominator_before = 1.0, denominator = 1.0;
    double value = 1.0;
    constexpr int most_terms = 100000;
    for (int k = 1; k < most_terms; ++k) {
        const double m = k / 2;  // NOLINT(bugprone-integer-division): d_2m and d_2m+1
        const double d = k % 2 == 0 ? m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m))
                                    : -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
        const double next_numerator = numerator + d * numerator_before;
        const double next_denominator = denominator + d * denominator_before;
        numerator_before = numerator / next_denominator;
        denominator_before = denominator / next_denominator;
        numerator = next_numerator / next_denominator;
        denominator = 1.0;
        if (std::abs(numerator - value) <= 1e-15 * std::abs(numerator)) return numerator;
        value = numerator;
    }
    return value;
}

}  // namespace

double incomplete_beta(double a, double b, double x) {
    assert(a > 0.0 && b > 0.0 && x >= 0.0 && x <= 1.0);
    if (x == 0.0 || x == 1.0) return x;
    if (x > (a + 1.0) / (a + b + 2.0)) return 1.0 - incomplete_beta(b, a, 1.0 - x);
    const double front = std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) +
                                  a * std::log(x) + b * std::log1p(-x));
    return front / a * fraction(a, b, x);
}

}  // namespace breach::statistics
