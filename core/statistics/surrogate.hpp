// A polynomial surrogate of the model, to vary one parameter at a time. Pure functions of samples
// and results.
#pragma once

#include <string>

#include "core/statistics/importance.hpp"

namespace breach::statistics {

/// Results for one parameter at its 10th and 90th percentile with the others at their medians; for
/// a choice, its options with the smallest and the largest result.
struct TornadoBar {
    std::string name;
    double p10, p90;
};

struct Tornado {
    double q2 = 0.0;               ///< cross-validated share of the variance
    std::string form;              ///< "linear", "squares", "squares and products"
    double at_median = 0.0;        ///< all at their medians, choices at their most frequent option
    std::vector<TornadoBar> bars;  ///< widest first; empty: refused
    std::string refused;           ///< reason
};
constexpr double least_q2 = 0.7;

/// Least-squares polynomial in the normal scores of the parameters' ranks (van der Waerden), with a
/// constant for each option of a choice. Of the forms with at most half as many terms as samples,
/// uses that with the largest Q2. Q2 = 1 - (sum of squared leave-one-out errors) / (sum of squared
/// deviations), the errors from the leverages (Allen 1974). Refused below least_q2. Correlated
/// parameters vary individually here, unlike in the samples.
Tornado tornado_of(std::span<const Drawn> parameters, std::span<const double> results);

}  // namespace breach::statistics
