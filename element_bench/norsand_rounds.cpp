// The rounds of the calibration: fit the hardening, compute the law's curves, read them as the
// tests were read, and correct the other values by the difference. Ends when no value moves any
// more, or after 25 rounds with a flag. Called by norsand_run.cpp. The values belong to calibrate()
// alone; TestReadings and Hardening do not change.

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/words/list.hpp"
#include "element_bench/norsand_hardening.hpp"

namespace breach::element_bench {

using fault::Severity;
using Sought = sought::Name;
using enum Sought;

namespace {

/// Covariance of a and b, from the scatter of two point sets about their own lines. The law's
/// deviations from its line are subtracted: they are no scatter.
std::optional<Eigen::Matrix2d> covariance_of_line(const Points& seen, const Points& own) {
    const std::size_t n = seen.x.size();
    // A line always fits two points: they show no scatter.
    if (n < 3 || own.x.size() != n) return std::nullopt;
    const Regression a = line_through(seen), b = line_through(own);
    double sum = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
        const double rest = seen.y[i] - a.a - a.b * seen.x[i] - (own.y[i] - b.a - b.b * own.x[i]);
        sum += seen.weight[i] * rest * rest;
    }
    return sum / static_cast<double>(n - 2) * a.inverse;
}

/// Standard errors from the scatter between tests. Correlated pairs (Gamma with lambda, M_tc with
/// N) are handed to the hardening as independent directions, the columns of their Cholesky factor.
OfEach<Estimate> estimates(const TestReadings& tests, const Hardening& hardening,
                           const Values& values, const Readings& of_law) {
    OfEach<Estimate> out;
    for (std::size_t k = 0; k < values.size(); ++k)
        out[k] = {
            values[k], std::nullopt, tests.problem.given[k] ? Origin::given : Origin::fitted, {}};
    const Readings measured = tests.comparable(of_law);
    const auto add = [&](Sought k, const std::optional<double>& error, const Indices& which) {
        if (tests.is_given(k)) return;
        out[k].error = error;
        out[k].tests = which;
    };
    const auto part = [](const std::optional<Eigen::Matrix2d>& covariance, Eigen::Index k) {
        return covariance ? std::optional(std::sqrt((*covariance)(k, k))) : std::nullopt;
    };
    const auto line = covariance_of_line(tests.line_points(measured), tests.line_points(of_law));
    add(Gamma, part(line, 0), tests.line);
    add(lambda, part(line, 1), tests.line);
    const Points ratios = tests.friction_points(measured);
    const auto friction = covariance_of_line(ratios, tests.friction_points(of_law));
    add(M_tc, tests.slope_held ? part(friction, 0) : std::nullopt, tests.friction);
    add(N, part(friction, 1), tests.friction);
    const Points seen = tests.dilatancy_points(measured, values);
    const Points own = tests.dilatancy_points(of_law, values);
    if (seen.x.size() >= 2 && own.x.size() == seen.x.size()) {
        double rest = 0.0, xx = 0.0;
        for (std::size_t i = 0; i < seen.x.size(); ++i) {
            rest += std::pow(seen.y[i] - slope_through_origin(seen) * seen.x[i] -
                                 (own.y[i] - slope_through_origin(own) * own.x[i]),
                             2);
            xx += seen.x[i] * seen.x[i];
        }
        add(chi_tc, std::sqrt(rest / static_cast<double>(seen.x.size() - 1) / xx), tests.dilating);
    } else {
        add(chi_tc, std::nullopt, tests.dilating);
    }
    const auto assume = [&](Sought k) {
        if (!tests.is_given(k)) out[k] = {values[k], {}, Origin::assumed, {}};
    };
    if (!tests.slope_held) assume(N);
    if (tests.dilating.empty()) assume(chi_tc);
    std::vector<Values> errors;
    const auto add_errors = [&](Sought a, Sought b, const Eigen::Matrix2d& covariance,
                                double sign) {
        if (tests.is_given(a) || tests.is_given(b)) return;
        const Eigen::Matrix2d L = covariance.llt().matrixL();
        if (!L.allFinite()) return;  // no scatter
        for (const Eigen::Index k : {0, 1}) {
            errors.push_back({});
            errors.back()[a] = L(0, k), errors.back()[b] = sign * L(1, k);
        }
    };
    if (line) add_errors(Gamma, lambda, *line, -1.0);
    if (friction && tests.slope_held) add_errors(M_tc, N, *friction, 1.0);
    if (out[chi_tc].error) {
        errors.push_back({});
        errors.back()[chi_tc] = *out[chi_tc].error;
    }
    hardening.estimate(values, errors, out);
    return out;
}

std::string names_of(const std::vector<TriaxialTest>& tests, const Indices& which) {
    return words::list_of(which, [&](std::size_t i) { return tests[i].name; });
}

/// Warns of parameters that the tests do not determine.
void warn(const TestReadings& tests, bool settled, NorSandFit& fit) {
    const std::string pointer = "/norsand_calibration/tests";
    const auto flag = [&](const char* code, Severity severity, const std::string& message) {
        fit.flags.push_back({code, severity, message, pointer});
    };
    if (!tests.line_reached && !(tests.is_given(Gamma) && tests.is_given(lambda))) {
        flag(
            "critical_state_not_reached", Severity::questionable,
            "fewer than two tests end at a critical state, or they end at one pressure: the line "
            "is "
            "carried on by the law from where the tests end; test on to larger strains and at more "
            "pressures, or give Gamma and lambda");
    }
    std::string assumed, weak;
    // H_psi is usually assumed, as its usual value 0 means one hardening for all densities.
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
                 names_of(tests.problem.tests, lost) + "; check e_0 and p_0");
    }
    if (!poor.empty()) {
        flag("poor_fit", Severity::warning,
             "q deviates by more than 15 % of its peak (rms) in " +
                 names_of(tests.problem.tests, poor) + "; check these tests, or S and elasticity");
    }
    if (!settled) {
        flag("calibration_not_settled", Severity::questionable,
             "the parameters still moved in the last round; look for tests that contradict others");
    }
}

}  // namespace

/// A law without a curve for a test drops that test from both sides of the comparison.
NorSandFit calibrate(const NorSandProblem& problem, const std::function<void(int, double)>& seen) {
    constexpr int most_rounds = 25;
    constexpr double settled_at = 2e-4;  // largest relative move
    const TestReadings tests(problem);
    Values values = tests.start();
    const Hardening hardening(problem, values);
    const Indices all = first(problem.tests.size());
    Readings of_law(all.size());
    std::vector<std::optional<TriaxialCurve>> found;
    bool settled = false;
    int round = 0;
    while (!settled && round < most_rounds) {
        values = hardening.fitted(values, round == 0);
        found = curves(problem, values, all);
        for (const std::size_t i : all) {
            // A reading of an earlier round would be compared with values that have moved since.
            of_law[i].reset();
            if (found[i]) of_law[i] = read_curve(problem.tests[i], *found[i], tests.peak_rows[i]);
        }
        ++round;
        const Values next = tests.corrected(values, of_law);
        const double moved = largest_move(values, next);
        settled = moved < settled_at;
        // The last correction is not applied: the values stay those of the curves.
        if (!settled && round < most_rounds) values = next;
        if (seen) seen(round, moved);
    }
    NorSandFit fit{
        with(problem, values), estimates(tests, hardening, values, of_law), {}, round, {}};
    for (const std::size_t i : all) {
        const TriaxialTest& test = problem.tests[i];
        TestFit each{.measured = *tests.measured[i],
                     .read_back = of_law[i],
                     .curve = found[i],
                     .psi_0 = psi(values, test.e_0, test.p_0),
                     .psi_peak = {}};
        if (const auto& peak = each.measured.peak) each.psi_peak = psi(values, peak->e, peak->p);
        if (each.curve) {
            const Deviation from = deviation_of(test, *each.curve);
            each.q_misfit = from.q.norm();
            each.volume_misfit = from.volume.norm();
        }
        fit.tests.push_back(std::move(each));
    }
    warn(tests, settled, fit);
    return fit;
}

}  // namespace breach::element_bench
