// Fits H by damped Gauss-Newton on the curves of the chosen tests. Uses the drained tests, or all
// if none is drained. Derivatives are differences, as the law's curves have none in closed form.
#include "element_bench/norsand_hardening.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace breach::element_bench {

namespace norsand = materials::norsand;

/// S softens undrained tests only; drained ones are computed without it.
std::vector<std::optional<TriaxialCurve>> curves(const NorSandProblem& problem,
                                                 const Values& values, const Indices& which) {
    norsand::Parameters law = with(problem, values);
    const double S = law.S;
    std::vector<std::optional<TriaxialCurve>> out;
    for (const std::size_t i : which) {
        law.S = is_drained(problem.tests[i].boundary) ? 0.0 : S;
        out.push_back(computed(problem.tests[i], norsand::ready(law), problem.options));
    }
    return out;
}

/// Places on an axis of the root of strain: the beginning of a curve, where it bends, counts more.
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

namespace {

/// The quantity that the fit reduces.
double sum_of_squares(const std::vector<Eigen::VectorXd>& parts) {
    double sum = 0.0;
    for (const Eigen::VectorXd& each : parts) sum += each.squaredNorm();
    return sum;
}

/// Derivatives of the deviations by ln H at the nodes, test by test.
template <class At>
std::vector<Eigen::MatrixXd> jacobians(const At& at, const Eigen::VectorXd& x,
                                       const std::vector<Eigen::VectorXd>& here) {
    // 0.5 % of H: far above the integration's tolerance of 1e-4 (norsand_problem_of), which would
    // show as noise of the derivative.
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

}  // namespace

/// Two nodes need three tests and a range of 0.03 in psi; else H_psi keeps its usual or given
/// value.
Hardening::Hardening(const NorSandProblem& problem, const Values& values) : problem_(problem) {
    using enum sought::Name;
    constexpr double least_range = 0.03;  // of psi_0
    for (std::size_t i = 0; i < problem_.tests.size(); ++i)
        if (is_drained(problem_.tests[i].boundary)) tests_.push_back(i);
    if (tests_.empty()) tests_ = first(problem_.tests.size());
    std::vector<double> states;
    for (const std::size_t i : tests_)
        states.push_back(psi(values, problem_.tests[i].e_0, problem_.tests[i].p_0));
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

std::vector<Eigen::VectorXd> Hardening::deviations(const Values& values) const {
    constexpr double least_volume = 0.005;  // least strain scale
    const auto found = curves(problem_, values, tests_);
    std::vector<Eigen::VectorXd> out;
    for (std::size_t k = 0; k < tests_.size(); ++k) {
        const TriaxialTest& test = problem_.tests[tests_[k]];
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

/// H is linear in psi, through its values at the nodes, and through H_0 if given.
Values Hardening::with_nodes(const Values& values, const Eigen::VectorXd& ln_H) const {
    using enum sought::Name;
    Values out = values;
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

/// The clamp keeps the logarithm finite where a line through given values falls below the least H.
Eigen::VectorXd Hardening::nodes(const Values& values) const {
    using enum sought::Name;
    Eigen::VectorXd out(static_cast<Eigen::Index>(node_psi_.size()));
    for (std::size_t k = 0; k < node_psi_.size(); ++k)
        out(static_cast<Eigen::Index>(k)) =
            std::log(std::clamp(values[H_0] - values[H_psi] * node_psi_[k], least[H_0], most[H_0]));
    return out;
}

/// Steps are limited to a factor e in H, and H to its bounds.
Values Hardening::fitted(const Values& values, bool from_afar) const {
    using enum sought::Name;
    if (node_psi_.empty()) return values;
    const auto at = [&](const Eigen::VectorXd& x) { return deviations(with_nodes(values, x)); };
    Eigen::VectorXd x = nodes(values);
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
        // The curves do not depend on H here: there is nothing to solve for.
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
    return with_nodes(values, x);
}

/// From the scatter between tests, as rows of one test are not independent: the sandwich A^-1 (sum
/// g_i g_i^T) A^-1 of the tests' gradients g_i. Adds the change of the fit due to one standard
/// error of each other parameter, uncorrelated.
void Hardening::estimate(const Values& values, const std::vector<Values>& errors,
                         OfEach<Estimate>& out) const {
    using enum sought::Name;
    const bool two = node_psi_.size() == 2;
    const bool level = !is_given(H_0), fall = two || (!level && !node_psi_.empty());
    if (level) out[H_0].tests = tests_;
    if (fall)
        out[H_psi].tests = tests_;
    else if (!is_given(H_psi))
        out[H_psi].origin = Origin::assumed;
    if (node_psi_.empty()) return;
    const std::size_t n = tests_.size();
    if (n <= node_psi_.size()) return;
    const Eigen::VectorXd x = nodes(values);
    const auto at = [&](const Eigen::VectorXd& moved) {
        return deviations(with_nodes(values, moved));
    };
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
        Values moved = with_nodes(values, x);
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

}  // namespace breach::element_bench
