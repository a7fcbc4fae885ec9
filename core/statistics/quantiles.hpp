// Normal, Student's and beta distributions. Boost.Math computes all but normal_cdf; its headers
// compile slowly, so only quantiles.cpp includes them.
#pragma once

#include <cstddef>

namespace breach::statistics {

/// Probability of every confidence interval in this folder.
inline constexpr double confidence = 0.9;

/// Standard normal distribution function Phi(z); relative error below 1e-14, also in the lower
/// tail.
double normal_cdf(double z);
/// Inverse of normal_cdf, 0 < p < 1. Accurate to 1e-14 (1 + |z|).
double normal_quantile(double p);
/// 95th percentile of the standard normal distribution, for intervals of 90 %.
inline constexpr double normal_quantile_of_95 = 1.6448536269514722;

/// t such that |T| <= t with probability `share` for Student's distribution with `freedom` >= 1
/// degrees of freedom. 0 < share < 1.
double student_factor(double share, std::size_t freedom);

/// I_x(a, b): probability that a beta variable with a, b > 0 is at most x in [0, 1].
double incomplete_beta(double a, double b, double x);

}  // namespace breach::statistics
