// Rank correlation: its measurement, and reordering to a given one.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/statistics/points.hpp"

namespace breach::statistics {

/// Square and symmetric, [row][column].
using Matrix = std::vector<std::vector<double>>;

/// The lower triangle L with L L' = the matrix; nothing: it is not positive definite.
std::optional<Matrix> cholesky(const Matrix& matrix);

/// Indices of the values, the smallest first; equal values keep their order.
std::vector<std::size_t> order_of(std::span<const double> values);
/// Ranks from 1; equal values share the mean of theirs.
std::vector<double> ranks_of(std::span<const double> values);
/// Spearman's coefficient of two equally long lists; 0 where one of them does not vary.
double rank_correlation(std::span<const double> a, std::span<const double> b);
/// Of the rows [from, to), between all dimensions.
Matrix rank_correlations(const Points& points, std::size_t from, std::size_t to);

/// Reorders each dimension of the rows [from, to) so that their rank correlations come as near to the
/// wanted ones as possible (Iman & Conover 1982, with van der Waerden's scores; the remaining error is
/// added to the target, up to 20 times, and the best order is kept; up to 256 rows are then swapped in
/// pairs as long as that helps). Every dimension keeps its values. No change if there are no more rows
/// than dimensions. wanted: positive definite.
void correlate(Points& points, std::size_t from, std::size_t to, const Matrix& wanted);

/// The same for points that must keep their places, those of a sequence: a normal copula with the
/// correlations 2 sin(pi r / 6), which give the rank correlation r.
void couple(Points& points, const Matrix& wanted);

}  // namespace breach::statistics
