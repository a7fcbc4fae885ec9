// Normal, Student's and beta distribution. Boost.Math computes all but normal_cdf: its headers compile
// slowly and stay in quantiles.cpp.
#pragma once

#include <cstddef>

namespace breach::statistics {

/// Every interval in this folder covers the estimated quantity in this share of studies.
inline constexpr double confidence = 0.9;

/// Phi(z) of the standard normal distribution; relative error below 1e-14 in the lower tail as well.
double normal_cdf(double z);
/// Its inverse, 0 < p < 1. Accurate to 1e-14 (1 + |z|).
double normal_quantile(double p);
/// 95th percentile of the standard normal distribution: end of an interval of this confidence.
inline constexpr double normal_quantile_of_95 = 1.6448536269514722;

/// t such that |T| <= t with probability `share` for Student's distribution with `freedom` >= 1
/// degrees of freedom. 0 < share < 1.
double student_factor(double share, std::size_t freedom);

/// I_x(a, b): the probability that a beta variable with a, b > 0 is at most x in [0, 1].
double incomplete_beta(double a, double b, double x);

}  // namespace breach::statistics
