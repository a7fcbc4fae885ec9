// Share of the spread of a result that comes from each parameter of a study. Pure functions of
// samples and results.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/statistics/percentiles.hpp"

namespace breach::statistics {

/// The sampled values of one parameter.
struct Drawn {
    std::string name;
    bool is_choice = false;      ///< values name options, which have no order
    std::vector<double> values;  ///< one per sample; of a choice the option's number
};

/// Entries are empty where they cannot be computed: too few samples, or nothing varies.
struct Importance {
    /// Spearman's, with the interval of Bonett & Wright (2000) in Fisher's z. Not for a choice: its
    /// options have no order.
    std::optional<Interval> rank_correlation;
    /// The same after removing from both what ranks of the other parameters, and choices, explain
    /// linearly (Saltelli et al. 2008, 1.2.5).
    std::optional<Interval> partial_rank_correlation;
    /// Share of the variance due to this parameter alone, V(E(Y | X)) / V(Y).
    std::optional<Interval> first_order;
};

/// In the order of the parameters. results: one per sample.
std::vector<Importance> importance_of(std::span<const Drawn> parameters,
                                      std::span<const double> results);

/// The parameter's columns in a regression on choices: one per option that occurs but the first.
Eigen::MatrixXd indicators_of(const Drawn& choice);

/// First-order index: the share of the variance explained by a straight line in each bin of the
/// parameter's values, or, for a choice, by the mean of each option (Pearson's correlation ratio);
/// minus what so many numbers explain by chance (epsilon squared, Kelley 1935). Lines, because means
/// of bins count the trend within a bin as scatter: for 64 samples of a line with S = 0.8 they gave
/// 0.75. The interval is the jackknife's (Efron & Stein 1981). groups: bin or option of each sample.
/// Nothing: fewer than two samples for each number of the fit, or constant results.
std::optional<Interval> share_explained(std::span<const std::size_t> groups,
                                        std::span<const double> values,
                                        std::span<const double> results);

/// 0.75 sqrt(n) bins of equally many samples each, at most 32; equal values share a bin.
std::vector<std::size_t> bins_of(std::span<const double> values);

}  // namespace breach::statistics
