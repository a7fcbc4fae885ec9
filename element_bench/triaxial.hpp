// Triaxial compression tests: the measured curve, the law's curve for the same test, and readings of
// either by one method: the end, whether it is a critical state, the peak.
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
    std::vector<double> epsilon_v;  ///< zeros where undrained
};

struct TriaxialTest {
    std::string name;
    Boundary boundary;  ///< drained_compression or undrained_compression
    double p_0;         ///< mean effective stress after consolidation [Pa]
    double K0;          ///< radial over axial effective stress then
    double e_0;
    TriaxialCurve measured;
};

/// Axial and radial effective stress after consolidation [Pa].
double axial_stress(const TriaxialTest& test);
double radial_stress(const TriaxialTest& test);
/// Void ratio after the volume strain epsilon_v.
double void_ratio(const TriaxialTest& test, double epsilon_v);
/// Excess pore pressure under a constant cell pressure [Pa].
double excess_pressure(const TriaxialTest& test, double q, double p);

/// The law's curve at the measured strains; nothing where it cannot begin from the test's state or
/// cannot follow the strain. step: of the strain where drained, over which the driver's lateral
/// strain is a straight line; a tenth of it where undrained: the peak is sharp, and calls are
/// cheap.
std::optional<TriaxialCurve> computed(const TriaxialTest& test,
                                      const materials::norsand::Ready& law,
                                      const materials::norsand::Options& options,
                                      double step = 1e-3);

/// Means over the last 15 % of the strain.
struct EndReading {
    double p, q, eta, e;
    double D;          ///< d epsilon_v / d epsilon_q, 0 where undrained
    double eta_error;  ///< standard error of eta, from its scatter
    /// Volume and stress ratio (drained), or p and q (undrained), are nearly constant
    bool critical;
};
/// At the largest stress ratio of a drained test. Elastic strain rates vanish there: D is plastic.
struct PeakReading {
    double epsilon_1, eta, D, p, e;
};
struct TriaxialReading {
    EndReading end;
    std::optional<PeakReading> peak;
};

/// Limits of a critical state: of |D|, and of the rates of eta, ln p and ln q per axial strain.
inline constexpr double critical_dilatancy = 0.05;
inline constexpr double critical_eta_rate = 1.0;
inline constexpr double critical_log_rate = 2.0;

/// Row of the measured curve where its smoothed stress ratio is largest, if it dilates there and
/// softens after.
std::optional<std::size_t> peak_row(const TriaxialTest& test);

/// peak: the row at which to read the peak; the measured one for the law's curve, too, so that a
/// peak shifted by scatter is compared at the same strains.
TriaxialReading read_curve(const TriaxialTest& test, const TriaxialCurve& curve,
                           std::optional<std::size_t> peak);

}  // namespace breach::element_bench
