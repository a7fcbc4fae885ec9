// Lines through readings of tests. Critical state line: e over ln p of the ends; M_tc and N: stress
// ratio over dilatancy, eta = M_tc - (1 - N) D; chi_tc: D over psi at the peaks, through the
// origin.
#include "element_bench/norsand_readings.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace breach::element_bench {

namespace norsand = materials::norsand;
using Sought = sought::Name;

namespace {

/// Usual values of sands and silts (docs/reference/methods/norsand.md, section 2): initial
/// estimates, kept for parameters that no test determines.
constexpr Values usual{0.9, 0.03, 1.25, 0.3, 4.0, 100.0, 0.0};

}  // namespace

double spread(const std::vector<double>& values) {
    if (values.empty()) return 0.0;
    const auto [low, high] = std::ranges::minmax(values);
    return high - low;
}

Indices first(std::size_t n) {
    Indices out(n);
    std::iota(out.begin(), out.end(), std::size_t{0});
    return out;
}

/// The pseudo-inverse gives the shortest solution where all points have one x, instead of failing.
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
double slope_through_origin(const Points& points) {
    double xy = 0.0, xx = 0.0;
    for (std::size_t i = 0; i < points.x.size(); ++i) {
        xy += points.x[i] * points.y[i];
        xx += points.x[i] * points.x[i];
    }
    return xy / xx;
}

/// The calibration knows the semi-logarithmic critical state line only.
norsand::Parameters with(const NorSandProblem& problem, const Values& values) {
    using enum Sought;
    norsand::Parameters law = problem.law;
    law.semi_log = {.Gamma = values[Gamma], .lambda = values[lambda]};
    law.M_tc = values[M_tc], law.N = values[N], law.chi_tc = values[chi_tc];
    law.H_0 = values[H_0], law.H_psi = values[H_psi];
    return law;
}

/// The line's reference pressure is 1 kPa, pressures are pascals: hence p / 1e3.
double psi(const Values& values, double e, double p) {
    return e - (values[Sought::Gamma] - values[Sought::lambda] * std::log(p / 1e3));
}

/// The order matters: slope_held reads the points of the tests that were just chosen.
TestReadings::TestReadings(const NorSandProblem& of) : problem(of) {
    constexpr double least_range = 0.3;  // of ln p, for a line
    constexpr std::size_t few = 3;
    std::vector<double> ln_p;
    std::size_t readings = 0;
    for (const TriaxialTest& test : problem.tests) {
        const std::size_t i = measured.size();
        peak_rows.push_back(peak_row(test));
        const TriaxialReading& read =
            *measured.emplace_back(read_curve(test, test.measured, peak_rows.back()));
        if (read.peak) dilating.push_back(i);
        if (read.end.critical) {
            line.push_back(i);
            ln_p.push_back(std::log(read.end.p));
        }
        readings += (read.peak ? 1U : 0U) + (read.end.critical ? 1U : 0U);
    }
    line_reached = line.size() >= 2 && spread(ln_p) >= least_range;
    if (!line_reached) line = first(measured.size());
    // Peaks and critical states; if these are few, every test's end.
    all_ends = readings < few;
    for (std::size_t i = 0; i < measured.size(); ++i)
        if (all_ends || measured[i]->peak || measured[i]->end.critical) friction.push_back(i);
    slope_held = !dilating.empty() && spread(friction_points(measured).x) >= critical_dilatancy;
}

Values TestReadings::start() const {
    Values values = usual;
    for (std::size_t k = 0; k < values.size(); ++k)
        if (problem.given[k]) values[k] = *problem.given[k];
    return corrected(values, {});
}

/// So that lines through measured and computed readings rest on the same tests.
Readings TestReadings::comparable(const Readings& of_law) const {
    Readings out = measured;
    for (std::size_t i = 0; i < of_law.size(); ++i)
        if (!of_law[i]) out[i].reset();
    return out;
}

/// e over ln of kilopascals, the axis that Gamma refers to.
Points TestReadings::line_points(const Readings& readings) const {
    Points points;
    for (const std::size_t i : line)
        if (readings[i]) points.add(std::log(readings[i]->end.p / 1e3), readings[i]->end.e);
    return points;
}

/// Stress ratio and dilatancy: peaks, and ends as points at or near D = 0.
Points TestReadings::friction_points(const Readings& readings) const {
    constexpr double between_tests = 0.01;  // of eta, scatter between specimens
    Points points;
    for (const std::size_t i : friction) {
        if (!readings[i]) continue;
        if (readings[i]->peak) points.add(readings[i]->peak->D, readings[i]->peak->eta);
        if (!measured[i]->end.critical && !all_ends) continue;
        // An end with much scatter counts less. Peaks have full weight: their parabola smooths
        // them.
        const double error = measured[i]->end.eta_error;
        points.add(readings[i]->end.D, readings[i]->end.eta,
                   1.0 / (1.0 + std::pow(error / between_tests, 2)));
    }
    return points;
}

Points TestReadings::dilatancy_points(const Readings& readings, const Values& values) const {
    Points points;
    for (const std::size_t i : dilating) {
        if (readings[i])
            points.add(psi(values, readings[i]->peak->e, readings[i]->peak->p),
                       readings[i]->peak->D);
    }
    return points;
}

/// Each value moves by measured minus computed reading and is clamped. M_tc alone moves where the
/// ratios lie at one D: their slope is then unknown. chi_tc stays below
/// most_chi_lambda M_tc / lambda: document.cpp refuses tests of steeper laws.
Values TestReadings::corrected(const Values& old, const Readings& of_law) const {
    using enum Sought;
    const Readings seen_of = comparable(of_law);
    const bool sets = of_law.empty();
    Values values = old;
    const auto move = [&](Sought k, double from_measured, double from_law) {
        if (is_given(k)) return;
        values[k] = std::clamp(sets ? from_measured : values[k] + from_measured - from_law,
                               least[k], most[k]);
    };
    const Points ends = line_points(seen_of);
    if (ends.x.size() >= 2) {
        const Regression seen = line_through(ends);
        const Regression own = sets ? seen : line_through(line_points(of_law));
        move(Gamma, seen.a, own.a);
        move(lambda, -seen.b, -own.b);
    }
    const Points ratios = friction_points(seen_of);
    if (!ratios.x.empty()) {
        const Points of_the_law = sets ? ratios : friction_points(of_law);
        if (slope_held) {
            const Regression seen = line_through(ratios);
            const Regression own = line_through(of_the_law);
            move(M_tc, seen.a, own.a);
            move(N, 1.0 + seen.b, 1.0 + own.b);
        } else {
            const auto level = [&](const Points& points) {
                double sum = 0.0, weight = 0.0;
                for (std::size_t i = 0; i < points.x.size(); ++i) {
                    sum += points.weight[i] * (points.y[i] + (1.0 - values[N]) * points.x[i]);
                    weight += points.weight[i];
                }
                return sum / weight;
            };
            move(M_tc, level(ratios), level(of_the_law));
        }
    }
    const Points dilation = dilatancy_points(seen_of, values);
    if (!dilation.x.empty()) {
        const double seen = slope_through_origin(dilation);
        const double own = sets ? seen : slope_through_origin(dilatancy_points(of_law, old));
        move(chi_tc, seen, own);
        constexpr double share = 0.95;  // confidence
        if (!is_given(chi_tc))
            values[chi_tc] = std::min(
                values[chi_tc], share * norsand::most_chi_lambda * values[M_tc] / values[lambda]);
    }
    return values;
}

/// Relative, but at least to a tenth of the usual value: N may be 0.
double largest_move(const Values& from, const Values& to) {
    using enum Sought;
    double largest = 0.0;
    for (const Sought k : {Gamma, lambda, M_tc, N, chi_tc})
        largest = std::max(largest, std::abs(to[k] - from[k]) / std::max(from[k], 0.1 * usual[k]));
    return largest;
}

}  // namespace breach::element_bench
