// Inside the calibration of NorSand only: what the tests say by themselves. Chooses the tests that
// determine each of Gamma, lambda, M_tc, N and chi_tc, and corrects these values by the readings of
// the law's curves. Nothing here changes after construction: calibrate() holds the values.
#pragma once

#include <Eigen/Core>

#include "element_bench/norsand_calibration.hpp"

namespace breach::element_bench {

using Indices = std::vector<std::size_t>;
using Readings = std::vector<std::optional<TriaxialReading>>;
using Values = OfEach<double>;

/// Limits of the sought parameters.
constexpr Values least{0.0, 1e-3, 0.3, 0.0, 0.2, 11.0, -1e4};
constexpr Values most{5.0, 0.5, 2.5, 0.9, 30.0, 5000.0, 1e4};

materials::norsand::Parameters with(const NorSandProblem& problem, const Values& values);
/// State parameter of a void ratio at a pressure [Pa].
double psi(const Values& values, double e, double p);
/// Largest minus smallest; 0 without values.
double spread(const std::vector<double>& values);
/// 0, 1, ... below n.
Indices first(std::size_t n);

/// Weighted points of a line.
struct Points {
    std::vector<double> x, y, weight;
    void add(double x_i, double y_i, double w_i = 1.0) {
        x.push_back(x_i), y.push_back(y_i), weight.push_back(w_i);
    }
};
/// Weighted least squares of y = a + b x.
struct Regression {
    double a, b;
    Eigen::Matrix2d inverse;  ///< of the normal matrix
};
Regression line_through(const Points& points);
/// The same through the origin.
double slope_through_origin(const Points& points);

struct TestReadings {
    explicit TestReadings(const NorSandProblem& problem);

    bool is_given(sought::Name k) const { return problem.given[k].has_value(); }
    /// Usual or given values, corrected by the measured readings.
    Values start() const;
    /// Corrects the calibrated values by the difference between the readings of the measured and of
    /// the law's curves; without the latter, sets them to the readings.
    Values corrected(const Values& old, const Readings& of_law) const;

    /// Measured readings of the tests for which the law has a curve.
    Readings comparable(const Readings& of_law) const;
    Points line_points(const Readings& readings) const;
    Points friction_points(const Readings& readings) const;
    Points dilatancy_points(const Readings& readings, const Values& line) const;

    const NorSandProblem& problem;
    std::vector<std::optional<std::size_t>> peak_rows;
    Readings measured;
    Indices line;  ///< tests whose ends give the critical state line
    bool line_reached = true;
    Indices friction;         ///< tests whose stress ratios give M_tc and N
    bool all_ends = false;    ///< uses all ends, critical or not
    bool slope_held = false;  ///< their D differ enough for N
    Indices dilating;         ///< tests with a peak: they give chi_tc
};

/// The largest relative change of the values that TestReadings corrects.
double largest_move(const Values& from, const Values& to);

}  // namespace breach::element_bench
