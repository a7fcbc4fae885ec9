#include "element_bench/norsand_calibration.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/words/list.hpp"

namespace breach::element_bench {

namespace norsand = materials::norsand;
using fault::Severity;

namespace {

using Indices = std::vector<std::size_t>;
using Readings = std::vector<std::optional<TriaxialReading>>;
using Values = OfEach<double>;
using Sought = sought::Name;

/// Usual values of sands and silts (docs/reference/methods/norsand.md, section 2): initial
/// estimates, kept for parameters that no test determines.
constexpr Values usual{0.9, 0.03, 1.25, 0.3, 4.0, 100.0, 0.0};
constexpr Values least{0.0, 1e-3, 0.3, 0.0, 0.2, 11.0, -1e4};
constexpr Values most{5.0, 0.5, 2.5, 0.9, 30.0, 5000.0, 1e4};

/// Weighted least squares of y = a + b x.
struct Regression {
    double a, b;
    Eigen::Matrix2d inverse;  ///< of the normal matrix
};
struct Points {
    std::vector<double> x, y, weight;
    void add(double x_i, double y_i, double w_i = 1.0) {
        x.push_back(x_i), y.push_back(y_i), weight.push_back(w_i);
    }
};
Regression line_through(const Points& points) {
    Eigen::Matrix2d A = Eigen::Matrix2d::Zero();
    Eigen::Vector2d c = Eigen::Vector2d::Zero();
    for (std::size_t i = 0; i < points.x.size(); ++i) {
        const Eigen::Vector2d row(1.0, points.x[i]);
        A += points.weight[i] * row * row.transpose();
        c += points.weight[i] * points.y[i] * row;
    }
    const Eigen::Matrix2d inverse = A.completeOrthogonalDecomposition().pseudoInverse();
    const Eigen::Vector2d ab = inverse * c;
    return {ab(0), ab(1), inverse};
}
/// The same through the origin.
double slope_through_origin(const Points& points) {
    double xy = 0.0, xx = 0.0;
    for (std::size_t i = 0; i < points.x.size(); ++i) {
        xy += points.x[i] * points.y[i];
        xx += points.x[i] * points.x[i];
    }
    return xy / xx;
}

norsand::Parameters with(const NorSandProblem& problem, const Values& values) {
    using enum Sought;
    norsand::Parameters law = problem.law;
    law.semi_log = {.Gamma = values[Gamma], .lambda = values[lambda]};
    law.M_tc = values[M_tc], law.N = values[N], law.chi_tc = values[chi_tc];
    law.H_0 = values[H_0], law.H_psi = values[H_psi];
    return law;
}

double psi(const Values& values, double e, double p) {
    return e - (values[Sought::Gamma] - values[Sought::lambda] * std::log(p / 1e3));
}

class Calibrator {
  public:
    explicit Calibrator(const NorSandProblem& problem) : problem_(problem) {
        for (const TriaxialTest& test : problem.tests) {
            peak_rows_.push_back(peak_row(test));
            measured_.emplace_back(read_curve(test, test.measured, peak_rows_.back()));
        }
        choose_line_tests();
        choose_friction_tests();
        values_ = usual;
        for (std::size_t k = 0; k < values_.size(); ++k)
            if (problem.given[k]) values_[k] = *problem.given[k];
        correct_by({});
        choose_hardening_tests();
    }

    NorSandFit run(const std::function<void(int, double)>& seen);

  private:
    using enum Sought;

    void choose_line_tests();
    void choose_friction_tests();
    void choose_hardening_tests();

    bool is_given(Sought k) const { return problem_.given[k].has_value(); }
    Indices all_tests() const;
    Indices dilating_tests() const;

    Readings comparable(const Readings& of_law) const;
    Points line_points(const Readings& readings) const;
    Points friction_points(const Readings& readings) const;
    Points dilatancy_points(const Readings& readings, const Values& line) const;
    /// Corrects the calibrated values by the difference between the readings of the measured and of
    /// the law's curves; without the latter, sets them to the readings. Returns the largest
    /// relative change.
    double correct_by(const Readings& of_law);

    std::vector<std::optional<TriaxialCurve>> curves(const Values& values,
                                                     const Indices& which) const;
    void fit_hardening(bool from_afar);
    Values with_nodes(const Eigen::VectorXd& ln_H) const;
    Eigen::VectorXd nodes() const;
    std::vector<Eigen::VectorXd> deviations(const Values& values) const;

    OfEach<Estimate> estimates(const Readings& of_law) const;
    void add_hardening_errors(const std::vector<Values>& errors, OfEach<Estimate>& out) const;
    void warn(NorSandFit& fit, bool settled) const;

    const NorSandProblem& problem_;
    std::vector<std::optional<std::size_t>> peak_rows_;
    Readings measured_;
    Values values_{};
    Indices line_;  ///< tests whose ends give the critical state line
    bool line_reached_ = true;
    Indices friction_;         ///< tests whose stress ratios give M_tc and N
    bool all_ends_ = false;    ///< uses all ends, critical or not
    bool slope_held_ = false;  ///< their D differ enough for N
    Indices hardening_;
    /// State parameters at which H is fitted: none if H is not calibrated or determined; one; or
    /// the smallest and the largest.
    std::vector<double> node_psi_;
};

double spread(const std::vector<double>& values) {
    if (values.empty()) return 0.0;
    const auto [low, high] = std::ranges::minmax(values);
    return high - low;
}

Indices Calibrator::all_tests() const {
    Indices out(measured_.size());
    std::iota(out.begin(), out.end(), std::size_t{0});
    return out;
}

/// Measured readings of the tests for which the law has a curve.
Readings Calibrator::comparable(const Readings& of_law) const {
    Readings out = measured_;
    for (std::size_t i = 0; i < of_law.size(); ++i)
        if (!of_law[i]) out[i].reset();
    return out;
}

void Calibrator::choose_line_tests() {
    constexpr double least_range = 0.3;  // of ln p, for a line
    std::vector<double> ln_p;
    for (std::size_t i = 0; i < measured_.size(); ++i) {
        if (!measured_[i]->end.critical) continue;
        line_.push_back(i);
        ln_p.push_back(std::log(measured_[i]->end.p));
    }
    line_reached_ = line_.size() >= 2 && spread(ln_p) >= least_range;
    if (line_reached_) return;
    line_ = all_tests();
}

/// Uses peaks and critical states; if these are few, every test's end.
void Calibrator::choose_friction_tests() {
    constexpr std::size_t few = 3;
    std::size_t readings = 0;
    for (const auto& each : measured_)
        readings += (each->peak ? 1U : 0U) + (each->end.critical ? 1U : 0U);
    all_ends_ = readings < few;
    for (std::size_t i = 0; i < measured_.size(); ++i)
        if (all_ends_ || measured_[i]->peak || measured_[i]->end.critical) friction_.push_back(i);
    const Points points = friction_points(measured_);
    slope_held_ = !dilating_tests().empty() && spread(points.x) >= critical_dilatancy;
}

void Calibrator::choose_hardening_tests() {
    constexpr double least_range = 0.03;  // of psi_0
    for (std::size_t i = 0; i < measured_.size(); ++i)
        if (is_drained(problem_.tests[i].boundary)) hardening_.push_back(i);
    if (hardening_.empty()) hardening_ = all_tests();
    std::vector<double> states;
    for (const std::size_t i : hardening_)
        states.push_back(psi(values_, problem_.tests[i].e_0, problem_.tests[i].p_0));
    const auto [low, high] = std::ranges::minmax(states);
    // if H is a line through (0, H_0), H_psi is best determined by the psi farthest from 0
    if (is_given(H_0)) {
        const double far = std::abs(low) > std::abs(high) ? low : high;
        if (!is_given(H_psi) && std::abs(far) >= least_range) node_psi_ = {far};
        return;
    }
    node_psi_ = {low};
    if (states.size() >= 3 && high - low >= least_range && !is_given(H_psi))
        node_psi_.push_back(high);
}

Indices Calibrator::dilating_tests() const {
    Indices out;
    for (std::size_t i = 0; i < measured_.size(); ++i)
        if (measured_[i]->peak) out.push_back(i);
    return out;
}

Points Calibrator::line_points(const Readings& readings) const {
    Points points;
    for (const std::size_t i : line_)
        if (readings[i]) points.add(std::log(readings[i]->end.p / 1e3), readings[i]->end.e);
    return points;
}

/// Stress ratio and dilatancy: peaks, and ends as points at or near D = 0.
Points Calibrator::friction_points(const Readings& readings) const {
    constexpr double between_tests = 0.01;  // of eta, scatter between specimens
    Points points;
    for (const std::size_t i : friction_) {
        if (!readings[i]) continue;
        if (readings[i]->peak) points.add(readings[i]->peak->D, readings[i]->peak->eta);
        if (!measured_[i]->end.critical && !all_ends_) continue;
        const double error = measured_[i]->end.eta_error;
        points.add(readings[i]->end.D, readings[i]->end.eta,
                   1.0 / (1.0 + std::pow(error / between_tests, 2)));
    }
    return points;
}

Points Calibrator::dilatancy_points(const Readings& readings, const Values& line) const {
    Points points;
    for (const std::size_t i : dilating_tests()) {
        if (readings[i])
            points.add(psi(line, readings[i]->peak->e, readings[i]->peak->p), readings[i]->peak->D);
    }
    return points;
}

double Calibrator::correct_by(const Readings& of_law) {
    const Readings measured = comparable(of_law);
    const bool first = of_law.empty();
    const Values old = values_;
    const auto move = [&](Sought k, double from_measured, double from_law) {
        if (is_given(k)) return;
        values_[k] = std::clamp(first ? from_measured : values_[k] + from_measured - from_law,
                                least[k], most[k]);
    };
    const Points ends = line_points(measured);
    if (ends.x.size() >= 2) {
        const Regression seen = line_through(ends);
        const Regression own = first ? seen : line_through(line_points(of_law));
        move(Gamma, seen.a, own.a);
        move(lambda, -seen.b, -own.b);
    }
    const Points ratios = friction_points(measured);
    if (!ratios.x.empty()) {
        const Points of_the_law = first ? ratios : friction_points(of_law);
        if (slope_held_) {
            const Regression seen = line_through(ratios);
            const Regression own = line_through(of_the_law);
            move(M_tc, seen.a, own.a);
            move(N, 1.0 + seen.b, 1.0 + own.b);
        } else {
            const auto level = [&](const Points& points) {
                double sum = 0.0, weight = 0.0;
                for (std::size_t i = 0; i < points.x.size(); ++i) {
                    sum += points.weight[i] * (points.y[i] + (1.0 - values_[N]) * points.x[i]);
                    weight += points.weight[i];
                }
                return sum / weight;
            };
            move(M_tc, level(ratios), level(of_the_law));
        }
    }
    const Points dilation = dilatancy_points(measured, values_);
    if (!dilation.x.empty()) {
        const double seen = slope_through_origin(dilation);
        const double own = first ? seen : slope_through_origin(dilatancy_points(of_law, old));
        move(chi_tc, seen, own);
        constexpr double share = 0.95;  // confidence
        if (!is_given(chi_tc))
            values_[chi_tc] = std::min(values_[chi_tc], share * norsand::most_chi_lambda *
                                                            values_[M_tc] / values_[lambda]);
    }
    double largest = 0.0;
    for (const Sought k : {Gamma, lambda, M_tc, N, chi_tc})
        largest =
            std::max(largest, std::abs(values_[k] - old[k]) / std::max(old[k], 0.1 * usual[k]));
    return largest;
}

std::vector<std::optional<TriaxialCurve>> Calibrator::curves(const Values& values,
                                                             const Indices& which) const {
    norsand::Parameters law = with(problem_, values);
    const double S = law.S;
    std::vector<std::optional<TriaxialCurve>> out;
    for (const std::size_t i : which) {
        law.S = is_drained(problem_.tests[i].boundary) ? 0.0 : S;
        out.push_back(computed(problem_.tests[i], norsand::ready(law), problem_.options));
    }
    return out;
}

/// Deviations of a test's curves. Rows are weighted by the root of their strain increment, as the
/// density of readings varies along the curve.
struct Deviation {
    Eigen::VectorXd q;       ///< over the largest q
    Eigen::VectorXd volume;  ///< epsilon_v if drained, p / p_0 if undrained
};
Deviation deviation_of(const TriaxialTest& test, const TriaxialCurve& curve) {
    const TriaxialCurve& seen = test.measured;
    const auto n = seen.q.size();
    const double q_most = *std::ranges::max_element(seen.q);
    const auto place = [&](std::size_t i) { return std::sqrt(seen.epsilon_1[i]); };
    const double range = place(n - 1) - place(0);
    const bool drained = is_drained(test.boundary);
    Deviation out{Eigen::VectorXd(static_cast<Eigen::Index>(n)),
                  Eigen::VectorXd(static_cast<Eigen::Index>(n))};
    for (std::size_t i = 0; i < n; ++i) {
        const double after = place(i + 1 == n ? i : i + 1), before = place(i == 0 ? 0 : i - 1);
        const double weight = std::sqrt(0.5 * (after - before) / range);
        const auto row = static_cast<Eigen::Index>(i);
        out.q(row) = weight * (curve.q[i] - seen.q[i]) / q_most;
        out.volume(row) = weight * (drained ? curve.epsilon_v[i] - seen.epsilon_v[i]
                                            : (curve.p[i] - seen.p[i]) / test.p_0);
    }
    return out;
}

std::vector<Eigen::VectorXd> Calibrator::deviations(const Values& values) const {
    constexpr double least_volume = 0.005;  // least strain scale
    const auto found = curves(values, hardening_);
    std::vector<Eigen::VectorXd> out;
    for (std::size_t k = 0; k < hardening_.size(); ++k) {
        const TriaxialTest& test = problem_.tests[hardening_[k]];
        const auto n = static_cast<Eigen::Index>(test.measured.q.size());
        Eigen::VectorXd both = Eigen::VectorXd::Ones(2 * n);  // if the law has no curve
        if (found[k]) {
            const Deviation each = deviation_of(test, *found[k]);
            const double unit = is_drained(test.boundary)
                                    ? std::max(spread(test.measured.epsilon_v), least_volume)
                                    : 1.0;
            both << each.q, each.volume / unit;
        }
        out.push_back(std::move(both));
    }
    return out;
}

double sum_of_squares(const std::vector<Eigen::VectorXd>& parts) {
    double sum = 0.0;
    for (const Eigen::VectorXd& each : parts) sum += each.squaredNorm();
    return sum;
}

/// H is linear in psi, through its values at the nodes, and through H_0 if given.
Values Calibrator::with_nodes(const Eigen::VectorXd& ln_H) const {
    Values out = values_;
    if (is_given(H_0)) {
        out[H_psi] = (out[H_0] - std::exp(ln_H(0))) / node_psi_[0];
        return out;
    }
    if (ln_H.size() == 1) {
        out[H_0] = std::exp(ln_H(0)) + out[H_psi] * node_psi_[0];
        return out;
    }
    out[H_psi] = (std::exp(ln_H(0)) - std::exp(ln_H(1))) / (node_psi_[1] - node_psi_[0]);
    out[H_0] = std::exp(ln_H(0)) + out[H_psi] * node_psi_[0];
    return out;
}

Eigen::VectorXd Calibrator::nodes() const {
    Eigen::VectorXd out(static_cast<Eigen::Index>(node_psi_.size()));
    for (std::size_t k = 0; k < node_psi_.size(); ++k)
        out(static_cast<Eigen::Index>(k)) = std::log(
            std::clamp(values_[H_0] - values_[H_psi] * node_psi_[k], least[H_0], most[H_0]));
    return out;
}

/// Derivatives of the deviations by ln H at the nodes, test by test.
template <class At>
std::vector<Eigen::MatrixXd> jacobians(const At& at, const Eigen::VectorXd& x,
                                       const std::vector<Eigen::VectorXd>& here) {
    constexpr double step = 5e-3;  // of ln H
    std::vector<Eigen::MatrixXd> out;
    for (const Eigen::VectorXd& each : here) out.emplace_back(each.size(), x.size());
    for (Eigen::Index k = 0; k < x.size(); ++k) {
        Eigen::VectorXd moved = x;
        moved(k) += step;
        const auto there = at(moved);
        for (std::size_t i = 0; i < here.size(); ++i) out[i].col(k) = (there[i] - here[i]) / step;
    }
    return out;
}

/// Damped Gauss-Newton; from_afar: starts at the best of some constant H.
void Calibrator::fit_hardening(bool from_afar) {
    if (node_psi_.empty()) return;
    const auto at = [&](const Eigen::VectorXd& x) { return deviations(with_nodes(x)); };
    Eigen::VectorXd x = nodes();
    auto here = at(x);
    if (from_afar) {
        for (const double H : {25.0, 50.0, 200.0, 400.0, 800.0}) {
            const Eigen::VectorXd tried = Eigen::VectorXd::Constant(x.size(), std::log(H));
            const auto there = at(tried);
            if (sum_of_squares(there) < sum_of_squares(here)) x = tried, here = there;
        }
    }
    double damping = 1e-3;
    const int most_moves = from_afar ? 10 : 2;  // later rounds start at the last result
    for (int move = 0; move < most_moves && damping < 1e3; ++move) {
        Eigen::MatrixXd A = Eigen::MatrixXd::Zero(x.size(), x.size());
        Eigen::VectorXd g = Eigen::VectorXd::Zero(x.size());
        const auto J = jacobians(at, x, here);
        for (std::size_t i = 0; i < J.size(); ++i) {
            A += J[i].transpose() * J[i];
            g += J[i].transpose() * here[i];
        }
        A.diagonal() *= 1.0 + damping;
        const Eigen::VectorXd d = A.ldlt().solve(-g).cwiseMax(-1.0).cwiseMin(1.0);
        const Eigen::VectorXd tried =
            (x + d).cwiseMax(std::log(least[H_0])).cwiseMin(std::log(most[H_0]));
        if (!tried.allFinite()) break;
        const auto there = at(tried);
        if (sum_of_squares(there) >= sum_of_squares(here)) {
            damping *= 10.0;
            if (d.cwiseAbs().maxCoeff() < 1e-4) break;
            continue;
        }
        damping *= 0.1;
        x = tried, here = there;
        if (d.cwiseAbs().maxCoeff() < 1e-4) break;
    }
    values_ = with_nodes(x);
}

/// Covariance of a and b, from the scatter of two point sets about their own lines. The law's
/// deviations from its line are subtracted: they are no scatter.
std::optional<Eigen::Matrix2d> covariance_of_line(const Points& seen, const Points& own) {
    const std::size_t n = seen.x.size();
    if (n < 3 || own.x.size() != n) return std::nullopt;
    const Regression a = line_through(seen), b = line_through(own);
    double sum = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
        const double rest = seen.y[i] - a.a - a.b * seen.x[i] - (own.y[i] - b.a - b.b * own.x[i]);
        sum += seen.weight[i] * rest * rest;
    }
    return sum / static_cast<double>(n - 2) * a.inverse;
}

OfEach<Estimate> Calibrator::estimates(const Readings& of_law) const {
    OfEach<Estimate> out;
    for (std::size_t k = 0; k < values_.size(); ++k)
        out[k] = {values_[k], std::nullopt, problem_.given[k] ? Origin::given : Origin::fitted, {}};
    const Readings measured = comparable(of_law);
    const auto add = [&](Sought k, const std::optional<double>& error, const Indices& tests) {
        if (is_given(k)) return;
        out[k].error = error;
        out[k].tests = tests;
    };
    const auto part = [](const std::optional<Eigen::Matrix2d>& covariance, Eigen::Index k) {
        return covariance ? std::optional(std::sqrt((*covariance)(k, k))) : std::nullopt;
    };
    const auto line = covariance_of_line(line_points(measured), line_points(of_law));
    add(Gamma, part(line, 0), line_);
    add(lambda, part(line, 1), line_);
    const Points ratios = friction_points(measured);
    const auto friction = covariance_of_line(ratios, friction_points(of_law));
    add(M_tc, slope_held_ ? part(friction, 0) : std::nullopt, friction_);
    add(N, part(friction, 1), friction_);
    const Points seen = dilatancy_points(measured, values_);
    const Points own = dilatancy_points(of_law, values_);
    if (seen.x.size() >= 2 && own.x.size() == seen.x.size()) {
        double rest = 0.0, xx = 0.0;
        for (std::size_t i = 0; i < seen.x.size(); ++i) {
            rest += std::pow(seen.y[i] - slope_through_origin(seen) * seen.x[i] -
                                 (own.y[i] - slope_through_origin(own) * own.x[i]),
                             2);
            xx += seen.x[i] * seen.x[i];
        }
        add(chi_tc, std::sqrt(rest / static_cast<double>(seen.x.size() - 1) / xx),
            dilating_tests());
    } else {
        add(chi_tc, std::nullopt, dilating_tests());
    }
    const auto assume = [&](Sought k) {
        if (!is_given(k)) out[k] = {values_[k], {}, Origin::assumed, {}};
    };
    if (!slope_held_) assume(N);
    if (dilating_tests().empty()) assume(chi_tc);
    std::vector<Values> errors;
    const auto add_errors = [&](Sought a, Sought b, const Eigen::Matrix2d& covariance,
                                double sign) {
        if (is_given(a) || is_given(b)) return;
        const Eigen::Matrix2d L = covariance.llt().matrixL();
        if (!L.allFinite()) return;  // no scatter
        for (const Eigen::Index k : {0, 1}) {
            errors.push_back({});
            errors.back()[a] = L(0, k), errors.back()[b] = sign * L(1, k);
        }
    };
    if (line) add_errors(Gamma, lambda, *line, -1.0);
    if (friction && slope_held_) add_errors(M_tc, N, *friction, 1.0);
    if (out[chi_tc].error) {
        errors.push_back({});
        errors.back()[chi_tc] = *out[chi_tc].error;
    }
    add_hardening_errors(errors, out);
    return out;
}

/// From the scatter between tests, as rows of one test are not independent: the sandwich A^-1 (sum
/// g_i g_i^T) A^-1 of the tests' gradients g_i. Adds the change of the fit due to one standard
/// error of each other parameter, uncorrelated.
void Calibrator::add_hardening_errors(const std::vector<Values>& errors,
                                      OfEach<Estimate>& out) const {
    const bool two = node_psi_.size() == 2;
    const bool level = !is_given(H_0), fall = two || (!level && !node_psi_.empty());
    if (level) out[H_0].tests = hardening_;
    if (fall)
        out[H_psi].tests = hardening_;
    else if (!is_given(H_psi))
        out[H_psi].origin = Origin::assumed;
    if (node_psi_.empty()) return;
    const std::size_t n = hardening_.size();
    if (n <= node_psi_.size()) return;
    const Eigen::VectorXd x = nodes();
    const auto at = [&](const Eigen::VectorXd& moved) { return deviations(with_nodes(moved)); };
    const auto here = at(x);
    const auto J = jacobians(at, x, here);
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(x.size(), x.size()), B = A;
    for (std::size_t i = 0; i < n; ++i) {
        const Eigen::VectorXd g = J[i].transpose() * here[i];
        A += J[i].transpose() * J[i];
        B += g * g.transpose();
    }
    const Eigen::MatrixXd inverse = A.inverse();
    const double few = static_cast<double>(n) / static_cast<double>(n - node_psi_.size());
    Eigen::MatrixXd covariance = few * inverse * B * inverse;
    for (const Values& error : errors) {
        Values moved = with_nodes(x);
        for (std::size_t k = 0; k < moved.size(); ++k) moved[k] += error[k];
        const auto there = deviations(moved);
        Eigen::VectorXd g = Eigen::VectorXd::Zero(x.size());
        for (std::size_t i = 0; i < n; ++i) g += J[i].transpose() * (there[i] - here[i]);
        const Eigen::VectorXd d = inverse * g;
        covariance += d * d.transpose();
    }
    Eigen::MatrixXd by_nodes = Eigen::MatrixXd::Zero(2, x.size());  // d(H_0, H_psi) / d ln H
    if (two) {
        const double width = node_psi_[1] - node_psi_[0];
        by_nodes.row(1) << std::exp(x(0)) / width, -std::exp(x(1)) / width;
        by_nodes.row(0) = node_psi_[0] * by_nodes.row(1);
    }
    if (level)
        by_nodes(0, 0) += std::exp(x(0));
    else
        by_nodes(1, 0) = -std::exp(x(0)) / node_psi_[0];
    const Eigen::MatrixXd both = by_nodes * covariance * by_nodes.transpose();
    if (level) out[H_0].error = std::sqrt(both(0, 0));
    if (fall) out[H_psi].error = std::sqrt(both(1, 1));
}

std::string names_of(const std::vector<TriaxialTest>& tests, const Indices& which) {
    return words::list_of(which, [&](std::size_t i) { return tests[i].name; });
}

/// Warns of parameters that the tests do not determine.
void Calibrator::warn(NorSandFit& fit, bool settled) const {
    const std::string pointer = "/norsand_calibration/tests";
    const auto flag = [&](const char* code, Severity severity, const std::string& message) {
        fit.flags.push_back({code, severity, message, pointer});
    };
    if (!line_reached_ && !(is_given(Gamma) && is_given(lambda))) {
        flag(
            "critical_state_not_reached", Severity::questionable,
            "fewer than two tests end at a critical state, or they end at one pressure: the line "
            "is "
            "carried on by the law from where the tests end; test on to larger strains and at more "
            "pressures, or give Gamma and lambda");
    }
    std::string assumed, weak;
    for (const Sought k : {Gamma, lambda, M_tc, N, chi_tc, H_0, H_psi}) {
        const Estimate& each = fit.estimates[k];
        const std::string name = sought::names[k];
        if (each.origin == Origin::assumed && k != H_psi)
            assumed += (assumed.empty() ? "" : ", ") + name;
        if (each.origin == Origin::fitted && each.tests.size() < 3)
            weak += (weak.empty() ? "" : ", ") + name;
    }
    if (!assumed.empty()) {
        flag("parameter_not_held", Severity::questionable,
             "no drained test dilates to a peak, or all to one: " + assumed +
                 " could not be read and have usual values; add dense drained tests or give them");
    }
    if (!weak.empty()) {
        flag("few_tests", Severity::warning, weak + " come from fewer than three tests; add tests");
    }
    constexpr double least_range = 0.03;
    std::vector<double> states;
    for (const TestFit& each : fit.tests) states.push_back(each.psi_0);
    if (spread(states) < least_range) {
        flag("one_density", Severity::warning,
             "all tests begin within 0.03 of one state parameter: chi_tc, N and H are not known "
             "beyond it; add looser or denser tests");
    }
    Indices lost, poor;
    constexpr double most_misfit = 0.15;
    for (std::size_t i = 0; i < fit.tests.size(); ++i) {
        if (!fit.tests[i].curve)
            lost.push_back(i);
        else if (fit.tests[i].q_misfit > most_misfit)
            poor.push_back(i);
    }
    if (!lost.empty()) {
        flag("test_not_computed", Severity::questionable,
             "the law with these parameters cannot begin or follow " +
                 names_of(problem_.tests, lost) + "; check e_0 and p_0");
    }
    if (!poor.empty()) {
        flag("poor_fit", Severity::warning,
             "q deviates by more than 15 % of its peak (rms) in " + names_of(problem_.tests, poor) +
                 "; check these tests, or S and elasticity");
    }
    if (!settled) {
        flag("calibration_not_settled", Severity::questionable,
             "the parameters still moved in the last round; look for tests that contradict others");
    }
}

NorSandFit Calibrator::run(const std::function<void(int, double)>& seen) {
    constexpr int most_rounds = 25;
    constexpr double settled_at = 2e-4;  // largest relative move
    const Indices all = all_tests();
    Readings of_law(all.size());
    std::vector<std::optional<TriaxialCurve>> found;
    bool settled = false;
    int round = 0;
    while (!settled && round < most_rounds) {
        fit_hardening(round == 0);
        found = curves(values_, all);
        for (const std::size_t i : all) {
            of_law[i].reset();
            if (found[i]) of_law[i] = read_curve(problem_.tests[i], *found[i], peak_rows_[i]);
        }
        ++round;
        const Values here = values_;
        const double moved = correct_by(of_law);
        settled = moved < settled_at;
        if (settled || round == most_rounds) values_ = here;  // the values of the curves
        if (seen) seen(round, moved);
    }
    NorSandFit fit{with(problem_, values_), estimates(of_law), {}, round, {}};
    for (const std::size_t i : all) {
        const TriaxialTest& test = problem_.tests[i];
        TestFit each{.measured = *measured_[i],
                     .read_back = of_law[i],
                     .curve = found[i],
                     .psi_0 = psi(values_, test.e_0, test.p_0),
                     .psi_peak = {}};
        if (const auto& peak = each.measured.peak) each.psi_peak = psi(values_, peak->e, peak->p);
        if (each.curve) {
            const Deviation from = deviation_of(test, *each.curve);
            each.q_misfit = from.q.norm();
            each.volume_misfit = from.volume.norm();
        }
        fit.tests.push_back(std::move(each));
    }
    warn(fit, settled);
    return fit;
}

}  // namespace

NorSandFit calibrate(const NorSandProblem& problem, const std::function<void(int, double)>& seen) {
    return Calibrator(problem).run(seen);
}

}  // namespace breach::element_bench
