// Share of the variance of a result due to each parameter of a study. Pure functions of samples and
// results.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/statistics/percentiles.hpp"

namespace breach::statistics {

/// Sampled values of one parameter.
struct Drawn {
    std::string name;
    bool is_choice = false;      ///< values are option numbers, without order
    std::vector<double> values;  ///< [samples]; of a choice, the option's number
};

/// Entries are empty if there are too few samples, or nothing varies.
struct Importance {
    /// Spearman's, with the interval of Bonett & Wright (2000) in Fisher's z. None for a choice.
    std::optional<Interval> rank_correlation;
    /// The same, after removing from both what the ranks of other parameters, and choices, explain
    /// linearly (Saltelli et al. 2008, 1.2.5).
    std::optional<Interval> partial_rank_correlation;
    /// Share of the variance due to this parameter alone, V(E(Y | X)) / V(Y).
    std::optional<Interval> first_order;
};

/// In the order of the parameters. results: [samples]
std::vector<Importance> importance_of(std::span<const Drawn> parameters,
                                      std::span<const double> results);

/// The choice's columns in a regression: one per occurring option except the first.
Eigen::MatrixXd indicators_of(const Drawn& choice);

/// First-order index: variance explained by a linear fit in each bin of the parameter's values, or
/// by the mean of each option of a choice (Pearson's correlation ratio), minus the variance that
/// the fitted numbers explain by chance (epsilon squared, Kelley 1935). Linear fits, because bin
/// means count the trend within a bin as scatter: 0.75 instead of 0.8 for 64 samples of a line.
/// Jackknife interval (Efron & Stein 1981). groups: bin or option of each sample. None: fewer than
/// two samples per fitted number, or constant results.
std::optional<Interval> share_explained(std::span<const std::size_t> groups,
                                        std::span<const double> values,
                                        std::span<const double> results);

/// 0.75 sqrt(n) bins of equally many samples, at most 32; equal values share a bin.
std::vector<std::size_t> bins_of(std::span<const double> values);

}  // namespace breach::statistics
