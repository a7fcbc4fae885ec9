// Percentiles of a sample with their confidence intervals, and its exceedance curve with a band.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/statistics/quantiles.hpp"

namespace breach::statistics {

/// An estimate and its confidence interval with probability `confidence`.
struct Interval {
    double value, low, high;
};

/// Fewest samples for the percentile p [%], 0 < p < 100: then it lies above the smallest with
/// probability 0.95, and below the largest with 0.95 (Wilks 1941), so that a two-sided 90 %
/// interval exists within the sample. 5 for the median, 29 for 10 and 90, 59 for 5 and 95.
std::size_t samples_needed(double p);

/// "20 samples are not enough for the 95th percentile: 59 are needed"
std::string not_enough(std::size_t samples, double p);

/// Percentile p [%] by linear interpolation between order statistics (type 7 of Hyndman & Fan 1996,
/// numpy's default), with its 90 % interval between fractional order statistics (Hutson 1999), for
/// any distribution; equal values are allowed. Needs samples_needed(p) values.
///
/// The interval assumes independent samples. Those of a Latin hypercube or Sobol sequence scatter
/// less: their interval is wider than necessary. Departs from: the percentile bootstrap, whose 90 %
/// intervals of the 95th percentile of 64 samples covered it in 82 % of 1,000 trials; these do in
/// 90 %.
Interval percentile(std::span<const double> values, double p);

struct Exceedance {
    double value;
    Interval probability;  ///< probability of a larger result
};
/// Share of values above each distinct value, ascending; at most `most_points` of them, with both
/// ends. The band is Wilson's (1927) 90 % interval, pointwise.
std::vector<Exceedance> exceedance(std::span<const double> values);
constexpr std::size_t most_points = 101;

/// Share of values below a limit, with Wilson's 90 % interval. Needs at least one value.
Interval share_below(std::span<const double> values, double limit);

}  // namespace breach::statistics
