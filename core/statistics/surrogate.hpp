// A polynomial in place of the model, to vary one parameter at a time. Pure functions of samples
// and results.
#pragma once

#include <string>

#include "core/statistics/importance.hpp"

namespace breach::statistics {

/// One parameter at its 10th and 90th percentile, the others at their medians; a choice at the
/// options with the smallest and the largest result.
struct TornadoBar {
    std::string name;
    double p10, p90;
};

struct Tornado {
    double q2 = 0.0;   ///< share of the variance that the surrogate predicts for samples left out
    std::string form;  ///< "linear", "squares", "squares and products"
    double at_median = 0.0;        ///< all at their medians, choices at their most frequent option
    std::vector<TornadoBar> bars;  ///< the widest first; empty: refused
    std::string refused;           ///< why there are none
};
constexpr double least_q2 = 0.7;

/// Least squares on a polynomial in the normal scores of the parameters (van der Waerden's, of their
/// ranks), and a constant for each option of a choice: of the forms with at most half as many terms
/// as samples the one with the largest Q2. Q2 = 1 - (sum of squared errors of each sample predicted
/// by the fit to all others) / (sum of squared deviations), the first from the leverages (Allen
/// 1974). Refused below least_q2. Scores are those of the samples as they are: correlated parameters
/// move one at a time here, unlike in the samples.
Tornado tornado_of(std::span<const Drawn> parameters, std::span<const double> results);

}  // namespace breach::statistics
