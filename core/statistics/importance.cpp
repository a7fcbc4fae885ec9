#include "core/statistics/importance.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <set>

#include "core/statistics/rank_correlation.hpp"

namespace breach::statistics {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::size_t least_samples = 5;

double mean_of(std::span<const double> values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double size_of(std::span<const double> values) { return static_cast<double>(values.size()); }

bool varies(std::span<const double> values) {
    return std::ranges::any_of(values, [&](double each) { return each != values.front(); });
}

VectorXd ranked(std::span<const double> values) {
    const std::vector<double> ranks = ranks_of(values);
    return Eigen::Map<const VectorXd>(ranks.data(), static_cast<Index>(ranks.size()));
}

/// Interval in Fisher's z = atanh(r), with the variance of Bonett & Wright (2000). degrees of
/// freedom: n - 3, minus one for each column removed.
Interval in_fishers_z(double r, double degrees) {
    const double half = normal_quantile_of_95 * std::sqrt((1.0 + 0.5 * r * r) / degrees);
    const double z = std::atanh(std::clamp(r, -1.0 + 1e-15, 1.0 - 1e-15));
    return {r, std::tanh(z - half), std::tanh(z + half)};
}

std::optional<Interval> spearman(std::span<const double> a, std::span<const double> b) {
    if (a.size() < least_samples || !varies(a) || !varies(b)) return std::nullopt;
    return in_fishers_z(rank_correlation(a, b), size_of(a) - 3.0);
}

/// Residuals of a least-squares fit to the columns.
VectorXd rest_of(const VectorXd& values, const Eigen::ColPivHouseholderQR<MatrixXd>& columns,
                 const MatrixXd& matrix) {
    return values - matrix * columns.solve(values);
}

/// A constant column, and every parameter except one: ranks, or indicators of options.
MatrixXd all_but(std::span<const Drawn> parameters, std::size_t left_out, Index samples) {
    MatrixXd matrix = MatrixXd::Ones(samples, 1);
    for (std::size_t j = 0; j < parameters.size(); ++j) {
        if (j == left_out) continue;
        const MatrixXd more = parameters[j].is_choice ? indicators_of(parameters[j])
                                                      : MatrixXd(ranked(parameters[j].values));
        matrix.conservativeResize(Eigen::NoChange, matrix.cols() + more.cols());
        matrix.rightCols(more.cols()) = more;
    }
    return matrix;
}

std::optional<Interval> partial_rank_correlation(std::span<const Drawn> parameters, std::size_t at,
                                                 std::span<const double> results) {
    const auto n = static_cast<Index>(results.size());
    const MatrixXd others = all_but(parameters, at, n);
    const auto degrees = static_cast<double>(n - 3 - (others.cols() - 1));
    if (degrees < 1.0) return std::nullopt;
    const Eigen::ColPivHouseholderQR<MatrixXd> solved(others);
    const VectorXd of_ranks = ranked(parameters[at].values);
    const VectorXd of_results = ranked(results);
    const VectorXd x = rest_of(of_ranks, solved, others);
    const VectorXd y = rest_of(of_results, solved, others);
    // If the others explain everything, only round-off is left.
    constexpr double round_off = 1e-10;
    if (x.norm() < round_off * of_ranks.norm() || y.norm() < round_off * of_results.norm())
        return std::nullopt;
    return in_fishers_z(x.dot(y) / (x.norm() * y.norm()), degrees);
}

/// Sums of one group or of all: x parameter, y result.
struct Sums {
    double count = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
    void add(const Eigen::Vector2d& at, double sign) {
        count += sign;
        x += sign * at.x();
        y += sign * at.y();
        xx += sign * at.x() * at.x();
        xy += sign * at.x() * at.y();
        yy += sign * at.y() * at.y();
    }
    double by_mean() const { return count > 0.0 ? y * y / count : 0.0; }
};

/// Sum of squares that a group's mean or line explains, and its number of coefficients.
struct Explained {
    double squares = 0.0;
    double numbers = 0.0;
    explicit Explained(const Sums& group)
        : squares(group.by_mean()), numbers(group.count > 0.0 ? 1.0 : 0.0) {
        if (group.count < 3.0) return;
        const double spread = group.xx - group.x * group.x / group.count;
        constexpr double round_off = 1e-12;  // all values of the parameter are equal
        if (spread <= round_off * group.xx) return;
        const double slope = group.xy - group.x * group.y / group.count;
        squares += slope * slope / spread;
        numbers += 1.0;
    }
};

/// 1 - (SSE / (n - numbers)) / (SST / (n - 1)).
double epsilon_squared(const Sums& all, double explained, double numbers) {
    const double total = all.yy - all.by_mean();
    return 1.0 - (all.yy - explained) / (all.count - numbers) * (all.count - 1.0) / total;
}

Interval jackknifed(double value, std::span<const double> without_one) {
    const double n = size_of(without_one);
    const double mean = mean_of(without_one);
    double squares = 0.0;
    for (const double each : without_one) squares += (each - mean) * (each - mean);
    const double half = normal_quantile_of_95 * std::sqrt((n - 1.0) / n * squares);
    const auto share = [](double number) { return std::clamp(number, 0.0, 1.0); };
    return {share(value), share(value - half), share(value + half)};
}

std::vector<std::size_t> options_of(const Drawn& choice) {
    std::vector<std::size_t> groups;
    for (const double each : choice.values) groups.push_back(static_cast<std::size_t>(each));
    return groups;
}

}  // namespace

MatrixXd indicators_of(const Drawn& choice) {
    const std::set<double> options(choice.values.begin(), choice.values.end());
    MatrixXd columns = MatrixXd::Zero(static_cast<Index>(choice.values.size()),
                                      std::max<Index>(static_cast<Index>(options.size()) - 1, 0));
    for (std::size_t i = 0; i < choice.values.size(); ++i) {
        const auto option = std::distance(options.begin(), options.find(choice.values[i]));
        if (option > 0) columns(static_cast<Index>(i), option - 1) = 1.0;
    }
    return columns;
}

std::optional<Interval> share_explained(std::span<const std::size_t> groups,
                                        std::span<const double> values,
                                        std::span<const double> results) {
    assert(groups.size() == results.size() && values.size() == results.size());
    if (results.size() < least_samples || !varies(results)) return std::nullopt;
    std::vector<Eigen::Vector2d> points;
    const Eigen::Vector2d mean(mean_of(values), mean_of(results));
    for (std::size_t i = 0; i < results.size(); ++i)
        points.push_back(Eigen::Vector2d(values[i], results[i]) - mean);
    std::vector<Sums> sums(*std::ranges::max_element(groups) + 1);
    Sums all;
    for (std::size_t i = 0; i < points.size(); ++i) {
        sums[groups[i]].add(points[i], 1.0);
        all.add(points[i], 1.0);
    }
    double explained = 0.0;
    double numbers = 0.0;
    for (const Sums& each : sums) {
        explained += Explained(each).squares;
        numbers += Explained(each).numbers;
    }
    if (numbers < 2.0 || all.count < 2.0 * numbers) return std::nullopt;
    std::vector<double> without_one;
    for (std::size_t i = 0; i < points.size(); ++i) {
        Sums rest = all;
        Sums own = sums[groups[i]];
        const Explained before(own);
        rest.add(points[i], -1.0);
        own.add(points[i], -1.0);
        const Explained after(own);
        if (rest.yy - rest.by_mean() <= 0.0) return std::nullopt;  // only one result differs
        without_one.push_back(epsilon_squared(rest, explained - before.squares + after.squares,
                                              numbers - before.numbers + after.numbers));
    }
    return jackknifed(epsilon_squared(all, explained, numbers), without_one);
}

std::vector<std::size_t> bins_of(std::span<const double> values) {
    constexpr std::size_t most_bins = 32;
    const std::size_t n = values.size();
    const auto bins = std::clamp<std::size_t>(
        static_cast<std::size_t>(0.75 * std::sqrt(size_of(values))), 1, most_bins);
    const std::vector<std::size_t> order = order_of(values);
    std::vector<std::size_t> found(n);
    for (std::size_t k = 0; k < n; ++k) {
        const bool as_before = k > 0 && values[order[k]] == values[order[k - 1]];
        found[order[k]] = as_before ? found[order[k - 1]] : k * bins / n;
    }
    return found;
}

std::vector<Importance> importance_of(std::span<const Drawn> parameters,
                                      std::span<const double> results) {
    std::vector<Importance> found;
    for (std::size_t j = 0; j < parameters.size(); ++j) {
        const Drawn& each = parameters[j];
        assert(each.values.size() == results.size());
        Importance made;
        if (results.size() >= least_samples && varies(results) && varies(each.values)) {
            made.first_order = share_explained(
                each.is_choice ? options_of(each) : bins_of(each.values), each.values, results);
            if (!each.is_choice) {
                made.rank_correlation = spearman(each.values, results);
                made.partial_rank_correlation = partial_rank_correlation(parameters, j, results);
            }
        }
        found.push_back(made);
    }
    return found;
}

}  // namespace breach::statistics
