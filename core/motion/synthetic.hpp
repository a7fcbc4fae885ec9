// A synthetic motion with given peak values, duration and Arias intensity: the same on every
// machine.
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

/// Harmonics of random phase with a Kanai-Tajimi spectrum (Kanai 1957, Tajimi 1960) under an
/// envelope that rises, holds and dies away; their dominant frequency, the envelope's length and
/// the peakedness |a|^m are found so that all four targets are met within 1 %. Base-corrected: ends
/// at rest. Throws BadInput when the targets cannot be met together.
Series synthetic_motion(const Target& target);

}  // namespace breach::motion
