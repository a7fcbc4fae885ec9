// Reads triaxial curves, measured and computed ones by the same rules, so that a bias of the
// reading is in both and cancels in the calibration. Readings of single rows would follow the
// scatter of a laboratory: values and slopes come from lines (end) and parabolas (peak) through
// many rows.
#include "element_bench/triaxial.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "element_bench/programme.hpp"

namespace breach::element_bench {

namespace norsand = materials::norsand;

/// From p = (sigma_a + 2 K0 sigma_a) / 3.
double axial_stress(const TriaxialTest& test) { return 3.0 * test.p_0 / (1.0 + 2.0 * test.K0); }
double radial_stress(const TriaxialTest& test) { return test.K0 * axial_stress(test); }

/// Logarithmic strain: (1 + e) / (1 + e_0) = exp(-epsilon_v).
double void_ratio(const TriaxialTest& test, double epsilon_v) {
    return (1.0 + test.e_0) * std::exp(-epsilon_v) - 1.0;
}

/// At constant total radial stress, u is what the effective radial stress p - q/3 has lost.
double excess_pressure(const TriaxialTest& test, double q, double p) {
    return radial_stress(test) + q / 3.0 - p;
}

namespace {

/// Linear interpolation in an ascending table; constant beyond its ends.
/// Rows of the law's path ascend, as its strain is driven in equal steps.
double between(std::span<const double> xs, std::span<const double> ys, double x) {
    const auto next = std::upper_bound(xs.begin(), xs.end(), x) - xs.begin();
    if (next == 0) return ys.front();
    if (static_cast<std::size_t>(next) == xs.size()) return ys.back();
    const auto k = static_cast<std::size_t>(next);
    const double share = (x - xs[k - 1]) / (xs[k] - xs[k - 1]);
    return ys[k - 1] + share * (ys[k] - ys[k - 1]);
}

struct Smoothed {
    double value, slope;
};

/// Value at `x` of the least-squares parabola (degree 2) or line through the points.
/// Abscissae are centred and scaled to their range, for the condition of the fit.
Smoothed smoothed(std::span<const double> xs, std::span<const double> ys, double x, int degree) {
    const auto n = static_cast<Eigen::Index>(xs.size());
    Eigen::MatrixXd A(n, degree + 1);
    Eigen::VectorXd y(n);
    const double scale = std::max(xs.back() - xs.front(), 1e-12);
    for (Eigen::Index i = 0; i < n; ++i) {
        const double t = (xs[static_cast<std::size_t>(i)] - x) / scale;
        for (int k = 0; k <= degree; ++k) A(i, k) = std::pow(t, k);
        y(i) = ys[static_cast<std::size_t>(i)];
    }
    const Eigen::VectorXd c = A.colPivHouseholderQr().solve(y);
    return {c(0), c(1) / scale};
}

/// d epsilon_v / d epsilon_q from the slope d epsilon_v / d epsilon_1.
/// epsilon_q = epsilon_1 - epsilon_v / 3 in triaxial compression.
double dilatancy(double slope) { return slope / (1.0 - slope / 3.0); }

/// Rows [from, to) of a column.
std::span<const double> part(const std::vector<double>& column, std::size_t from, std::size_t to) {
    return std::span(column).subspan(from, to - from);
}

double mean(std::span<const double> values) {
    double sum = 0.0;
    for (const double each : values) sum += each;
    return sum / static_cast<double>(values.size());
}

std::vector<double> stress_ratios(const TriaxialCurve& curve) {
    std::vector<double> eta;
    for (std::size_t i = 0; i < curve.q.size(); ++i) eta.push_back(curve.q[i] / curve.p[i]);
    return eta;
}

/// A window of 15 % of the strain, or of five rows in a sparse file.
/// A straight line: over this window curves bend little, and a parabola would follow the scatter.
EndReading read_end(const TriaxialTest& test, const TriaxialCurve& curve,
                    const std::vector<double>& eta) {
    constexpr double window = 0.15;
    constexpr std::size_t least_rows = 5;
    const auto& strain = curve.epsilon_1;
    const std::size_t n = strain.size();
    const double from = strain.back() - window * (strain.back() - strain.front());
    const auto found = std::lower_bound(strain.begin(), strain.end(), from) - strain.begin();
    const std::size_t first = std::min(static_cast<std::size_t>(found), n - least_rows);
    const auto x = part(strain, first, n), ratio = part(eta, first, n);
    const double middle = mean(x);
    const auto at = [&](const std::vector<double>& column) {
        return smoothed(x, part(column, first, n), middle, 1);
    };
    const Smoothed p = at(curve.p), q = at(curve.q), volume = at(curve.epsilon_v), r = at(eta);
    double scatter = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i)
        scatter += std::pow(ratio[i] - r.value - r.slope * (x[i] - middle), 2);
    const auto rows = static_cast<double>(x.size());
    const bool drained = is_drained(test.boundary);
    const double D = drained ? dilatancy(volume.slope) : 0.0;
    // Undrained volume is constant by itself: only p and q tell whether the state still moves.
    const bool critical =
        drained ? std::abs(D) <= critical_dilatancy && std::abs(r.slope) <= critical_eta_rate
                : std::abs(p.slope) <= critical_log_rate * p.value &&
                      std::abs(q.slope) <= critical_log_rate * q.value;
    return {.p = p.value,
            .q = q.value,
            .eta = q.value / p.value,
            .e = void_ratio(test, volume.value),
            .D = D,
            .eta_error = std::sqrt(scatter / (rows - 2.0) / rows),
            .critical = critical};
}

/// Number of rows on both sides of a row for smoothing.
struct Window {
    std::size_t from, to;
};
/// None near the ends of a test: a parabola with points on one side has a wrong slope.
std::optional<Window> window_around(const std::vector<double>& strain, std::size_t row) {
    constexpr double reach = 0.0075;       // strain on either side
    constexpr std::size_t least_rows = 2;  // on either side
    if (row < least_rows || row + least_rows >= strain.size()) return std::nullopt;
    const double x = strain[row];
    if (x - reach < strain.front() || x + reach > strain.back()) return std::nullopt;
    const auto low = std::lower_bound(strain.begin(), strain.end(), x - reach) - strain.begin();
    const auto high = std::upper_bound(strain.begin(), strain.end(), x + reach) - strain.begin();
    return Window{std::min(static_cast<std::size_t>(low), row - least_rows),
                  std::max(static_cast<std::size_t>(high), row + least_rows + 1)};
}

/// The parabola through a column around a row, at that row.
Smoothed around(const std::vector<double>& strain, const std::vector<double>& column,
                std::size_t row, const Window& window) {
    return smoothed(part(strain, window.from, window.to), part(column, window.from, window.to),
                    strain[row], 2);
}

/// `row` must have a window_around() it: peak_row() returns only such rows.
PeakReading read_peak(const TriaxialTest& test, const TriaxialCurve& curve,
                      const std::vector<double>& eta, std::size_t row) {
    const Window window = *window_around(curve.epsilon_1, row);
    const auto at = [&](const std::vector<double>& column) {
        return around(curve.epsilon_1, column, row, window);
    };
    const Smoothed volume = at(curve.epsilon_v);
    return {.epsilon_1 = curve.epsilon_1[row],
            .eta = at(eta).value,
            .D = dilatancy(volume.slope),
            .p = at(curve.p).value,
            .e = void_ratio(test, volume.value)};
}

}  // namespace

/// The law runs at a step of its own and is interpolated to the measured strains: rows of a
/// laboratory can be too far apart for the law. A state that initialise() had to change (shrunk,
/// raised) is not the test's, and so has no curve.
std::optional<TriaxialCurve> computed(const TriaxialTest& test, const norsand::Ready& law,
                                      const norsand::Options& options, double step) {
    const double axial = axial_stress(test), radial = radial_stress(test);
    const norsand::Beginning begun =
        norsand::initialise(law, Voigt(-radial, -axial, -radial, 0.0), test.e_0);
    if (begun.eta_limit <= 0.0 || begun.shrunk || begun.raised) return std::nullopt;
    const double per_call = is_drained(test.boundary) ? step : 0.1 * step;
    const Record record = monotonic({NorSandPoint{law, options, begun.state}}, test.boundary,
                                    test.measured.epsilon_1.back(), {.step = per_call, .every = 1});
    if (record.outcome != Ending::done) return std::nullopt;
    TriaxialCurve path;
    for (const Reading& each : record.readings) {
        path.epsilon_1.push_back(each.strain);
        path.q.push_back(each.sigma_yy - each.sigma_xx);
        path.p.push_back((each.sigma_xx + each.sigma_yy + each.sigma_zz) / 3.0);
        path.epsilon_v.push_back(each.epsilon_v);
    }
    TriaxialCurve out{.epsilon_1 = test.measured.epsilon_1, .q = {}, .p = {}, .epsilon_v = {}};
    for (const double x : out.epsilon_1) {
        out.q.push_back(between(path.epsilon_1, path.q, x));
        out.p.push_back(between(path.epsilon_1, path.p, x));
        out.epsilon_v.push_back(between(path.epsilon_1, path.epsilon_v, x));
    }
    return out;
}

/// A peak is one where the soil both dilates and later softens: in loose soil the largest ratio is
/// at the end of the test, and would be read twice.
std::optional<std::size_t> peak_row(const TriaxialTest& test) {
    constexpr double least_dilation = 0.02, least_softening = 0.005;  // of D, of eta
    if (!is_drained(test.boundary)) return std::nullopt;
    const TriaxialCurve& curve = test.measured;
    const std::vector<double> eta = stress_ratios(curve);
    std::optional<std::size_t> peak;
    double largest = 0.0;
    for (std::size_t i = 0; i < eta.size(); ++i) {
        const auto window = window_around(curve.epsilon_1, i);
        if (!window) continue;
        const double ratio = around(curve.epsilon_1, eta, i, *window).value;
        if (ratio > largest) largest = ratio, peak = i;
    }
    if (!peak || largest - read_end(test, curve, eta).eta < least_softening) return std::nullopt;
    if (read_peak(test, curve, eta, *peak).D > -least_dilation) return std::nullopt;
    return peak;
}

TriaxialReading read_curve(const TriaxialTest& test, const TriaxialCurve& curve,
                           std::optional<std::size_t> peak) {
    const std::vector<double> eta = stress_ratios(curve);
    TriaxialReading out{read_end(test, curve, eta), std::nullopt};
    if (peak) out.peak = read_peak(test, curve, eta, *peak);
    return out;
}

}  // namespace breach::element_bench
