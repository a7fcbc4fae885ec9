// Back-analysis: the value of one parameter for which a result has a given value. Pure: from the
// known results it returns the next runs, or the solution.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/statistics/percentiles.hpp"

namespace breach::statistics {

/// A value of the parameter, run with one or several lattices of points.
struct InverseStep {
    double value;
    std::vector<double> results;  ///< of the completed lattices
    bool open = false;            ///< some runs are incomplete
    std::size_t moving = 0;       ///< results that are lower bounds: the soil still moved
    std::size_t stood = 0;        ///< results without transfer: no soil was released, they are 0
};

struct InverseQuestion {
    double target;
    std::string quantity;  ///< with its unit, for messages
    std::string unit;
    double low, high;               ///< range of the search
    bool logarithmic;               ///< bisect the logarithm, for factors
    double tolerance = 0.02;        ///< of the value, relative (to the range, unless logarithmic)
    std::size_t most_values = 100;  ///< limit of the search
};

/// How lower bounds near the target bound the solution.
enum class Bound { none, at_least, at_most };

struct InverseAdvice {
    std::vector<double> run_next;   ///< empty: wait, or done
    std::optional<Interval> found;  ///< low and high: if there is an interval
    bool has_interval = false;
    Bound bound = Bound::none;
    std::optional<double> noise;  ///< pooled standard deviation of one run due to its lattice
    std::string refused;          ///< why there is no solution
    std::string remark;           ///< a caveat of the interval
};

/// Runs both ends, then bisects until the bracket is within the tolerance, or until the results at
/// its ends differ by no more than the noise of a mean. The solution is interpolated; if a range of
/// values gives the target itself, as a runout of 0, it is the end of that range. Its interval: all
/// values whose result, interpolated between neighbouring steps, is within t s / sqrt(lattices) of
/// the target. s is the noise pooled over the steps, t Student's factor of 90 %
/// (core/statistics/repeats.hpp). The interval excludes the uncertainty of the model and of the
/// other parameters, which stay at their medians. Assumes a monotone result, except for such a
/// range. Without a transfer the result is 0 and discontinuous: the noise excludes such results.
InverseAdvice advise_inverse(const InverseQuestion& question, std::span<const InverseStep> steps);

}  // namespace breach::statistics
