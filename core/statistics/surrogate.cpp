#include "core/statistics/surrogate.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "core/statistics/quantiles.hpp"
#include "core/statistics/rank_correlation.hpp"
#include "core/words/number.hpp"
#include "core/words/words.hpp"

namespace breach::statistics {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

enum class Form { linear, squares, products };
constexpr auto words_of(Form) {
    return words::in_order<Form>({{Form::linear, "linear"},
                                  {Form::squares, "squares"},
                                  {Form::products, "squares and products"}});
}

VectorXd normal_scores(std::span<const double> values) {
    const std::vector<double> ranks = ranks_of(values);
    VectorXd scores(static_cast<Index>(ranks.size()));
    for (std::size_t i = 0; i < ranks.size(); ++i)
        scores(static_cast<Index>(i)) =
            normal_quantile(ranks[i] / (static_cast<double>(ranks.size()) + 1.0));
    return scores;
}

/// One point in parameter space.
struct Coordinates {
    RowVectorXd scores;   ///< of numeric parameters
    RowVectorXd options;  ///< of choices: 1 for the chosen option, else 0
};

/// Column of a parameter: its score, or the first of its options.
struct Block {
    Index first, count;
};

/// Inputs of the polynomial.
struct Inputs {
    MatrixXd scores;   ///< [samples][numbers]
    MatrixXd options;  ///< [samples][columns of options]
    std::vector<Block> blocks;
    Coordinates at(Index sample) const { return {scores.row(sample), options.row(sample)}; }
};

Inputs inputs_of(std::span<const Drawn> parameters, Index samples) {
    Inputs inputs{MatrixXd(samples, 0), MatrixXd(samples, 0), {}};
    for (const Drawn& each : parameters) {
        MatrixXd& into = each.is_choice ? inputs.options : inputs.scores;
        const MatrixXd more =
            each.is_choice ? indicators_of(each) : MatrixXd(normal_scores(each.values));
        inputs.blocks.push_back({into.cols(), more.cols()});
        into.conservativeResize(Eigen::NoChange, into.cols() + more.cols());
        into.rightCols(more.cols()) = more;
    }
    return inputs;
}

/// One point's terms: 1, options, scores, squares, products.
RowVectorXd terms_of(const Coordinates& place, Form form) {
    const auto& [scores, options] = place;
    const Index k = scores.size();
    std::vector<double> terms{1.0};
    terms.insert(terms.end(), options.begin(), options.end());
    terms.insert(terms.end(), scores.begin(), scores.end());
    for (Index i = 0; form != Form::linear && i < k; ++i)
        terms.push_back(scores(i) * scores(i) - 1.0);  // Hermite polynomial: zero mean
    for (Index i = 0; form == Form::products && i < k; ++i)
        for (Index j = 0; j < i; ++j) terms.push_back(scores(i) * scores(j));
    return Eigen::Map<RowVectorXd>(terms.data(), static_cast<Index>(terms.size()));
}

struct Fit {
    Form form = Form::linear;
    VectorXd coefficients;
    double q2 = 0.0;
    double at(const Coordinates& place) const { return terms_of(place, form).dot(coefficients); }
};

/// None: too many terms for the samples, or dependent terms.
std::optional<Fit> fitted(const Inputs& inputs, const VectorXd& y, Form form) {
    const Index n = y.size();
    const Index terms = terms_of(inputs.at(0), form).size();
    if (2 * terms > n) return std::nullopt;
    MatrixXd matrix(n, terms);
    for (Index i = 0; i < n; ++i) matrix.row(i) = terms_of(inputs.at(i), form);
    const Eigen::ColPivHouseholderQR<MatrixXd> solved(matrix);
    if (solved.rank() < terms) return std::nullopt;
    Fit fit{.form = form, .coefficients = solved.solve(y)};
    const MatrixXd q = solved.householderQ() * MatrixXd::Identity(n, terms);
    const VectorXd rest = y - matrix * fit.coefficients;
    double squares = 0.0;
    for (Index i = 0; i < n; ++i) {
        const double others = 1.0 - q.row(i).squaredNorm();  // 1 - leverage
        if (others < 1e-10) return std::nullopt;             // this sample alone determines a term
        squares += std::pow(rest(i) / others, 2);
    }
    fit.q2 = 1.0 - squares / (y.array() - y.mean()).square().sum();
    return fit;
}

std::optional<Fit> best_fit(const Inputs& inputs, const VectorXd& y) {
    std::optional<Fit> best;
    for (const Form form : words::values<Form>) {
        std::optional<Fit> fit = fitted(inputs, y, form);
        if (fit && (!best || fit->q2 > best->q2)) best = std::move(fit);
    }
    return best;
}

/// The point with one option of a choice; -1: the first, which has no column.
Coordinates with_option(Coordinates place, const Block& block, Index option) {
    place.options.segment(block.first, block.count).setZero();
    if (option >= 0) place.options(block.first + option) = 1.0;
    return place;
}

Index most_frequent(const Inputs& inputs, const Block& block) {
    const RowVectorXd count = inputs.options.middleCols(block.first, block.count).colwise().sum();
    // count of the first option
    double most = static_cast<double>(inputs.options.rows()) - count.sum();
    Index found = -1;
    for (Index option = 0; option < count.size(); ++option)
        if (count(option) > most) most = count(found = option);
    return found;
}

/// Scores 0, and the most frequent option of each choice.
Coordinates middle_of(const Inputs& inputs, std::span<const Drawn> parameters) {
    Coordinates middle{RowVectorXd::Zero(inputs.scores.cols()),
                       RowVectorXd::Zero(inputs.options.cols())};
    for (std::size_t j = 0; j < parameters.size(); ++j)
        if (parameters[j].is_choice)
            middle = with_option(middle, inputs.blocks[j], most_frequent(inputs, inputs.blocks[j]));
    return middle;
}

TornadoBar bar_of_number(const Fit& fit, Coordinates place, const Block& block) {
    const auto at = [&](double share) {
        place.scores(block.first) = normal_quantile(share);
        return fit.at(place);
    };
    return {.name = "", .p10 = at(0.1), .p90 = at(0.9)};
}

// NOLINTNEXTLINE(performance-unnecessary-value-param): called as bar_of_number is, which changes its copy
TornadoBar bar_of_choice(const Fit& fit, Coordinates place, const Block& block) {
    TornadoBar bar{.name = "", .p10 = fit.at(with_option(place, block, -1)), .p90 = 0.0};
    bar.p90 = bar.p10;
    for (Index option = 0; option < block.count; ++option) {
        const double here = fit.at(with_option(place, block, option));
        bar.p10 = std::min(bar.p10, here);
        bar.p90 = std::max(bar.p90, here);
    }
    return bar;
}

}  // namespace

Tornado tornado_of(std::span<const Drawn> parameters, std::span<const double> results) {
    const auto n = static_cast<Index>(results.size());
    const VectorXd y = Eigen::Map<const VectorXd>(results.data(), n);
    Tornado tornado;
    if (n < 2 || (y.array() == y(0)).all()) {
        tornado.refused = "the results do not vary";
        return tornado;
    }
    const Inputs inputs = inputs_of(parameters, n);
    const std::optional<Fit> fit = best_fit(inputs, y);
    if (!fit) {
        tornado.refused = std::to_string(n) + " samples are too few for a surrogate of " +
                          std::to_string(parameters.size()) + " parameters";
        return tornado;
    }
    tornado.q2 = fit->q2;
    tornado.form = words::name_of(fit->form);
    if (fit->q2 < least_q2) {
        tornado.refused = "Q2 is " + words::formatted("%.2f", fit->q2) + "; " +
                          words::formatted("%.2f", least_q2) + " is needed";
        return tornado;
    }
    const Coordinates middle = middle_of(inputs, parameters);
    tornado.at_median = fit->at(middle);
    for (std::size_t j = 0; j < parameters.size(); ++j) {
        const auto bar_of = parameters[j].is_choice ? bar_of_choice : bar_of_number;
        tornado.bars.push_back(bar_of(*fit, middle, inputs.blocks[j]));
        tornado.bars.back().name = parameters[j].name;
    }
    std::ranges::stable_sort(tornado.bars, std::greater{},
                             [](const TornadoBar& bar) { return std::abs(bar.p90 - bar.p10); });
    return tornado;
}

}  // namespace breach::statistics
