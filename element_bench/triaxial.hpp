// Triaxial compression tests: measured curve, the law's curve for the same test, and one method to
// read both: end, critical state or not, peak.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "element_bench/specimen.hpp"

namespace breach::element_bench {

/// Rows of a test, compression positive; strains are logarithmic.
struct TriaxialCurve {
    std::vector<double> epsilon_1;  ///< axial, ascending
    std::vector<double> q;          ///< [Pa]
    std::vector<double> p;          ///< mean effective stress [Pa]
    std::vector<double> epsilon_v;  ///< 0 if undrained
};

struct TriaxialTest {
    std::string name;
    Boundary boundary;  ///< drained_compression or undrained_compression
    double p_0;         ///< mean effective stress after consolidation [Pa]
    double K0;          ///< radial over axial effective stress after consolidation
    double e_0;
    TriaxialCurve measured;
};

/// Axial and radial effective stress after consolidation [Pa].
double axial_stress(const TriaxialTest& test);
double radial_stress(const TriaxialTest& test);
/// Void ratio after the volumetric strain epsilon_v.
double void_ratio(const TriaxialTest& test, double epsilon_v);
/// Excess pore pressure at constant cell pressure [Pa].
double excess_pressure(const TriaxialTest& test, double q, double p);

/// The law's curve at the measured strains; none if the law cannot start from the test's state or
/// follow the strain. step: drained: strain step with linear lateral strain; undrained: a tenth of
/// it, as the peak is sharp and calls are cheap.
std::optional<TriaxialCurve> computed(const TriaxialTest& test,
                                      const materials::norsand::Ready& law,
                                      const materials::norsand::Options& options,
                                      double step = 1e-3);

/// Averages over the last 15 % of the strain.
struct EndReading {
    double p, q, eta, e;
    double D;          ///< d epsilon_v / d epsilon_q, 0 if undrained
    double eta_error;  ///< standard error of eta, from its scatter
    /// volume and stress ratio (drained), or p and q (undrained), are nearly constant
    bool critical;
};
/// At the largest stress ratio of a drained test. The elastic strain rates vanish there: D is
/// plastic.
struct PeakReading {
    double epsilon_1, eta, D, p, e;
};
struct TriaxialReading {
    EndReading end;
    std::optional<PeakReading> peak;
};

/// Limits of a critical state: |D|, and rates of eta, ln p and ln q per axial strain.
inline constexpr double critical_dilatancy = 0.05;
inline constexpr double critical_eta_rate = 1.0;
inline constexpr double critical_log_rate = 2.0;

/// Row of the largest smoothed stress ratio of the measured curve, if it dilates there and softens
/// afterwards.
std::optional<std::size_t> peak_row(const TriaxialTest& test);

/// peak: row at which to read the peak. Use the measured row for the law's curve too: a peak
/// shifted by scatter is then compared at equal strains.
TriaxialReading read_curve(const TriaxialTest& test, const TriaxialCurve& curve,
                           std::optional<std::size_t> peak);

}  // namespace breach::element_bench
