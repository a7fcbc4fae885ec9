// The value of one parameter at which a result is a given number: back-analysis. Pure: given what is
// known, it says what to run next, or what was found.
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
    std::size_t moving = 0;       ///< of the results: lower bounds, their soil still moved
    std::size_t stood = 0;        ///< of the results: nothing was let go, they are 0
};

struct InverseQuestion {
    double target;
    std::string quantity;  ///< with its unit in the sentences
    std::string unit;
    double low, high;         ///< ends of the range that is searched
    bool logarithmic;         ///< halve in the logarithm: factors
    double tolerance = 0.02;  ///< of the value, relative (of the range, where not logarithmic)
    std::size_t most_values = 100;  ///< the search ends with these
};

/// What lower bounds beside the target make of the value found.
enum class Bound { none, at_least, at_most };

struct InverseAdvice {
    std::vector<double> run_next;   ///< empty: wait, or there is nothing more to learn
    std::optional<Interval> found;  ///< low and high: where the interval can be told
    bool has_interval = false;
    Bound bound = Bound::none;
    std::optional<double> noise;  ///< standard deviation of one run by its lattice, pooled
    std::string refused;          ///< why there is no value
    std::string remark;           ///< what to know of the interval
};

/// Both ends first; then the bracket is halved until it is as narrow as the tolerance, or until the
/// results at its ends differ by no more than the noise of a mean. The value is interpolated between
/// them; where a stretch of values gives the target itself, as a runout of 0, it is the end of that
/// stretch. Its interval: all values whose result, interpolated between neighbouring steps, is within
/// t s / sqrt(lattices) of the target (of such a stretch its end alone), s the noise pooled over the
/// steps and t Student's factor of 90 % (core/statistics/repeats.hpp). It says nothing
/// of the other parameters, which stay at their medians, nor of the model. Assumed: the result rises
/// or falls all the way between the ends, but for such a stretch. Where nothing was let go the result
/// is 0, and jumps beside it: noise is of the others.
InverseAdvice advise_inverse(const InverseQuestion& question, std::span<const InverseStep> steps);

}  // namespace breach::statistics
