#include "core/statistics/rank_correlation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/statistics/quantiles.hpp"

namespace breach::statistics {

namespace {

constexpr std::size_t most_rounds = 20;
constexpr double near_enough = 1e-3;
constexpr std::size_t most_rows_to_swap = 256;

Matrix square(std::size_t n) { return Matrix(n, std::vector<double>(n, 0.0)); }

double pearson(std::span<const double> a, std::span<const double> b) {
    const auto n = static_cast<double>(a.size());
    const double mean_a = std::accumulate(a.begin(), a.end(), 0.0) / n;
    const double mean_b = std::accumulate(b.begin(), b.end(), 0.0) / n;
    double aa = 0.0, bb = 0.0, ab = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        aa += (a[i] - mean_a) * (a[i] - mean_a);
        bb += (b[i] - mean_b) * (b[i] - mean_b);
        ab += (a[i] - mean_a) * (b[i] - mean_b);
    }
    return aa > 0.0 && bb > 0.0 ? ab / std::sqrt(aa * bb) : 0.0;
}

/// [dimensions][rows]
using Columns = std::vector<std::vector<double>>;

Matrix correlations(const Columns& columns) {
    Matrix found = square(columns.size());
    for (std::size_t a = 0; a < columns.size(); ++a) {
        found[a][a] = 1.0;
        for (std::size_t b = 0; b < a; ++b)
            found[a][b] = found[b][a] = pearson(columns[a], columns[b]);
    }
    return found;
}

Columns ranks_of_columns(const Columns& columns) {
    Columns ranks;
    for (const auto& each : columns) ranks.push_back(ranks_of(each));
    return ranks;
}

Columns columns_of(const Points& points, std::size_t from, std::size_t to) {
    Columns columns(points.front().size());
    for (std::size_t i = from; i < to; ++i)
        for (std::size_t d = 0; d < columns.size(); ++d) columns[d].push_back(points[i][d]);
    return columns;
}

/// Normal scores of the ranks.
Columns scores_of(const Columns& columns) {
    Columns scores = ranks_of_columns(columns);
    for (auto& column : scores)
        for (double& each : column)
            each = normal_quantile(each / (static_cast<double>(column.size()) + 1.0));
    return scores;
}

/// P Q^-1 for the lower triangles P and Q.
Matrix quotient(const Matrix& p, const Matrix& q) {
    const std::size_t n = p.size();
    Matrix s = square(n);
    for (std::size_t row = 0; row < n; ++row) {
        for (std::size_t k = row + 1; k-- > 0;) {
            double rest = p[row][k];
            for (std::size_t j = k + 1; j <= row; ++j) rest -= s[row][j] * q[j][k];
            s[row][k] = rest / q[k][k];
        }
    }
    return s;
}

/// Each dimension becomes a combination of itself and those before it.
Columns mixed(const Columns& columns, const Matrix& lower) {
    Columns sums(columns.size(), std::vector<double>(columns.front().size(), 0.0));
    for (std::size_t d = 0; d < columns.size(); ++d)
        for (std::size_t k = 0; k <= d; ++k)
            for (std::size_t i = 0; i < columns[d].size(); ++i)
                sums[d][i] += lower[d][k] * columns[k][i];
    return sums;
}

/// The values, in the order of the guide's ranks.
std::vector<double> reordered(const std::vector<double>& values, const std::vector<double>& guide) {
    std::vector<double> sorted = values;
    std::ranges::sort(sorted);
    const std::vector<std::size_t> order = order_of(guide);
    std::vector<double> placed(values.size());
    for (std::size_t i = 0; i < order.size(); ++i) placed[order[i]] = sorted[i];
    return placed;
}

double largest_difference(const Matrix& a, const Matrix& b) {
    double largest = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            largest = std::max(largest, std::abs(a[i][j] - b[i][j]));
    return largest;
}

/// Normal correlations for these rank correlations; unchanged if that is not positive definite.
Matrix of_normal(const Matrix& rank) {
    Matrix normal = rank;
    for (std::size_t a = 0; a < rank.size(); ++a)
        for (std::size_t b = 0; b < rank.size(); ++b)
            if (a != b) normal[a][b] = 2.0 * std::sin(std::numbers::pi * rank[a][b] / 6.0);
    return cholesky(normal) ? normal : rank;
}

/// Swaps pairs within a dimension while that reduces the error of Iman & Conover's order, which is
/// large for few rows.
class Swapping {
  public:
    Swapping(Columns& columns, const Matrix& wanted)
        : columns_(columns), ranks_(ranks_of_columns(columns)), miss_(correlations(ranks_)) {
        const double middle = 0.5 * (static_cast<double>(ranks_.front().size()) + 1.0);
        for (const double each : ranks_.front()) scale_ += (each - middle) * (each - middle);
        for (std::size_t a = 0; a < wanted.size(); ++a)
            for (std::size_t b = 0; b < wanted.size(); ++b) miss_[a][b] -= wanted[a][b];
    }

    void settle() {
        constexpr int most_sweeps = 10;
        const std::size_t rows = ranks_.front().size();
        for (int sweep = 0; sweep < most_sweeps; ++sweep) {
            bool moved = false;
            for (std::size_t d = 1; d < columns_.size(); ++d)
                for (std::size_t i = 0; i < rows; ++i)
                    for (std::size_t j = 0; j < i; ++j) moved |= swap_if_nearer(d, i, j);
            if (!moved) return;
        }
    }

  private:
    bool swap_if_nearer(std::size_t d, std::size_t i, std::size_t j) {
        constexpr double worth_it = 1e-9;
        const double step = (ranks_[d][j] - ranks_[d][i]) / scale_;
        double gain = 0.0;
        for (std::size_t k = 0; k < ranks_.size(); ++k) {
            if (k == d) continue;
            const double moved = miss_[d][k] + step * (ranks_[k][i] - ranks_[k][j]);
            gain += miss_[d][k] * miss_[d][k] - moved * moved;
        }
        if (gain < worth_it) return false;
        for (std::size_t k = 0; k < ranks_.size(); ++k)
            if (k != d) miss_[k][d] = miss_[d][k] += step * (ranks_[k][i] - ranks_[k][j]);
        std::swap(ranks_[d][i], ranks_[d][j]);
        std::swap(columns_[d][i], columns_[d][j]);
        return true;
    }

    Columns& columns_;
    Columns ranks_;
    Matrix miss_;         ///< actual minus wanted
    double scale_ = 0.0;  ///< sum of squares of the ranks about their mean
};

}  // namespace

std::optional<Matrix> cholesky(const Matrix& matrix) {
    constexpr double least_pivot = 1e-10;
    Matrix lower = square(matrix.size());
    for (std::size_t i = 0; i < matrix.size(); ++i) {
        for (std::size_t j = 0; j <= i; ++j) {
            double rest = matrix[i][j];
            for (std::size_t k = 0; k < j; ++k) rest -= lower[i][k] * lower[j][k];
            if (i == j && rest < least_pivot) return std::nullopt;
            lower[i][j] = i == j ? std::sqrt(rest) : rest / lower[j][j];
        }
    }
    return lower;
}

std::vector<std::size_t> order_of(std::span<const double> values) {
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return values[i]; });
    return order;
}

std::vector<double> ranks_of(std::span<const double> values) {
    const std::vector<std::size_t> order = order_of(values);
    std::vector<double> ranks(values.size());
    for (std::size_t from = 0; from < order.size();) {
        std::size_t to = from + 1;
        while (to < order.size() && values[order[to]] == values[order[from]]) ++to;
        for (std::size_t i = from; i < to; ++i)
            ranks[order[i]] = 0.5 * static_cast<double>(from + 1 + to);
        from = to;
    }
    return ranks;
}

double rank_correlation(std::span<const double> a, std::span<const double> b) {
    return pearson(ranks_of(a), ranks_of(b));
}

void correlate(Points& points, std::size_t from, std::size_t to, const Matrix& wanted) {
    if (to - from <= wanted.size() + 1 || wanted.size() < 2) return;
    const Columns values = columns_of(points, from, to);
    const Columns scores = scores_of(values);
    const auto own = cholesky(correlations(scores));
    if (!own) return;
    Matrix target = of_normal(wanted);
    Columns best = values;
    double best_miss = largest_difference(correlations(ranks_of_columns(values)), wanted);
    for (std::size_t round = 0; round < most_rounds && best_miss > near_enough; ++round) {
        const auto lower = cholesky(target);
        if (!lower) break;
        const Columns guides = mixed(scores, quotient(*lower, *own));
        Columns placed;
        for (std::size_t d = 0; d < values.size(); ++d)
            placed.push_back(reordered(values[d], guides[d]));
        const Matrix reached = correlations(ranks_of_columns(placed));
        for (std::size_t a = 0; a < target.size(); ++a)
            for (std::size_t b = 0; b < target.size(); ++b)
                target[a][b] += wanted[a][b] - reached[a][b];
        const double miss = largest_difference(reached, wanted);
        if (miss >= best_miss) continue;
        best_miss = miss;
        best = std::move(placed);
    }
    if (best_miss > near_enough && to - from <= most_rows_to_swap) Swapping(best, wanted).settle();
    for (std::size_t i = from; i < to; ++i)
        for (std::size_t d = 0; d < best.size(); ++d) points[i][d] = best[d][i - from];
}

void couple(Points& points, const Matrix& wanted) {
    const auto lower = cholesky(of_normal(wanted));
    if (!lower) return;
    for (std::vector<double>& point : points) {
        std::vector<double> z;
        for (const double u : point) z.push_back(normal_quantile(u));
        for (std::size_t d = 0; d < point.size(); ++d) {
            double sum = 0.0;
            for (std::size_t k = 0; k <= d; ++k) sum += (*lower)[d][k] * z[k];
            if (d > 0 && sum != z[d])
                point[d] = std::clamp(normal_cdf(sum), 0x1p-54, 1.0 - 0x1p-53);
        }
    }
}

}  // namespace breach::statistics
