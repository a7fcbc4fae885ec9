// A synthetic motion with given peaks, duration and Arias intensity; the same on every machine.
#pragma once

#include <cstdint>

#include "core/motion/series.hpp"

namespace breach::motion {

struct Target {
    double peak_acceleration;  ///< [m/s2]
    double peak_velocity;      ///< [m/s]
    double strong_duration;    ///< from 5 % to 95 % of the Arias intensity [s]
    double arias_intensity;    ///< [m/s]
    double length;             ///< of the whole motion [s]
    double dt;                 ///< [s]
    std::uint64_t seed;
};

/// Harmonics of random phase with a Kanai-Tajimi spectrum (Kanai 1957, Tajimi 1960), under an
/// envelope that rises, stays constant and decays. Finds the dominant frequency, the envelope's
/// length and the exponent m in |a|^m so that all four targets are met within 1 %.
/// Baseline-corrected. Throws BadInput if the targets contradict each other.
Series synthetic_motion(const Target& target);

}  // namespace breach::motion
