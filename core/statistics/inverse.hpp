// Back-analysis: the value of one parameter at which a result is a given number. Pure: from the
// known results it returns the next runs, or the value found.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/statistics/percentiles.hpp"

namespace breach::statistics {

/// A value of the parameter that was run, on one lattice of points or on several.
struct InverseStep {
    double value;
    std::vector<double> results;  ///< of the lattices that have one
    bool open = false;            ///< some still run
    std::size_t moving = 0;       ///< results that are lower bounds: their soil still moved
    std::size_t stood = 0;        ///< results without a transfer: no soil was released, they are 0
};

struct InverseQuestion {
    double target;
    std::string quantity;  ///< named with its unit in sentences
    std::string unit;
    double low, high;         ///< ends of the range that is searched
    bool logarithmic;         ///< halve in the logarithm: factors
    double tolerance = 0.02;  ///< of the value, relative (of the range, where not logarithmic)
    std::size_t most_values = 100;  ///< the search ends after so many
};

/// Effect of lower bounds beside the target on the value found.
enum class Bound { none, at_least, at_most };

struct InverseAdvice {
    std::vector<double> run_next;   ///< empty: wait, or nothing more to run
    std::optional<Interval> found;  ///< low and high: where an interval exists
    bool has_interval = false;
    Bound bound = Bound::none;
    std::optional<double> noise;  ///< standard deviation of one run by its lattice, pooled
    std::string refused;          ///< why there is no value
    std::string remark;           ///< a caveat of the interval
};

/// Both ends first; then the bracket is halved until it is as narrow as the tolerance, or until the
/// results at its ends differ by no more than the noise of a mean. The value is interpolated between
/// them; where a stretch of values gives the target itself, as a runout of 0, it is the end of that
/// stretch. Its interval: all values with a result, interpolated between neighbouring steps, within t
/// s / sqrt(lattices) of the target (of such a stretch its end alone), s the noise pooled over the
/// steps and t Student's factor of 90 % (core/statistics/repeats.hpp). It excludes the uncertainty of
/// the other parameters, which stay at their medians, and of the model. Assumed: the result rises or
/// falls all the way between the ends, except for such a stretch. Without a transfer the result is 0
/// and jumps beside it: noise excludes such results.
InverseAdvice advise_inverse(const InverseQuestion& question, std::span<const InverseStep> steps);

}  // namespace breach::statistics
