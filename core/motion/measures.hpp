// Intensity measures of a motion.
#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "core/motion/series.hpp"

namespace breach::motion {

inline constexpr double spectrum_damping = 0.05;  ///< of critical [-]

/// Pseudo-acceleration omega^2 max |u| of an oscillator with this period [s] [m/s2]; exact for an
/// acceleration that is linear between samples (Nigam & Jennings 1969).
double spectral_acceleration(const Series& acceleration, double period,
                             double damping = spectrum_damping);

struct Measures {
    double pga;         ///< [m/s2]
    double pgv;         ///< [m/s]
    double pgd;         ///< after baseline correction [m]
    double arias;       ///< [m/s]
    StrongPart strong;  ///< its duration is D5-95
    double cav;         ///< cumulative absolute velocity, integral of |a| [m/s]
    /// Modified acceleration spectrum intensity: integral of the 5 % pseudo-acceleration over
    /// periods of 0.1 to 2 s [m/s]; Von Thun et al. (1988) take 0.1 to 0.5 s.
    double masi;
    std::vector<double> periods;   ///< [s]
    std::vector<double> spectrum;  ///< 5 % pseudo-acceleration [m/s2]
};

Measures measures_of(const Series& acceleration);
nlohmann::json as_json(const Measures& measures);

struct NamedMeasure {
    const char* name;  ///< its key
    const char* title;
    const char* unit;
};
inline constexpr std::array named_measures{NamedMeasure{"pga_g", "PGA", "g"},
                                           NamedMeasure{"pgv", "PGV", "m/s"},
                                           NamedMeasure{"pgd", "PGD", "m"},
                                           NamedMeasure{"arias", "Arias intensity", "m/s"},
                                           NamedMeasure{"strong_duration", "D5-95", "s"},
                                           NamedMeasure{"cav", "CAV", "m/s"},
                                           NamedMeasure{"masi", "MASI", "m/s"}};

}  // namespace breach::motion
