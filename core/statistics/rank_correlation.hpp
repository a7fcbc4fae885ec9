// Computes rank correlations, and reorders samples to given ones.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/statistics/points.hpp"

namespace breach::statistics {

/// Square and symmetric, [row][column].
using Matrix = std::vector<std::vector<double>>;

/// The lower triangle L with L L' = the matrix; none: not positive definite.
std::optional<Matrix> cholesky(const Matrix& matrix);

/// Indices of the values, the smallest first; equal values keep their order.
std::vector<std::size_t> order_of(std::span<const double> values);
/// Ranks from 1; equal values share their mean rank.
std::vector<double> ranks_of(std::span<const double> values);
/// Spearman's coefficient of two equally long lists; 0 if one is constant.
double rank_correlation(std::span<const double> a, std::span<const double> b);

/// Reorders each dimension of the rows [from, to) to approximate the wanted rank correlations. By
/// Iman & Conover (1982) with van der Waerden's scores, up to 20 times with the remaining error
/// added to the target; keeps the best order. Up to 256 rows are then swapped in pairs while that
/// helps. Each dimension keeps its values. No change if there are no more rows than dimensions.
/// wanted: positive definite.
void correlate(Points& points, std::size_t from, std::size_t to, const Matrix& wanted);

/// The same without reordering, for points of a sequence: a normal copula with the correlations 2
/// sin(pi r / 6), which give the rank correlation r.
void couple(Points& points, const Matrix& wanted);

}  // namespace breach::statistics
