// Earthquake motions as equally spaced samples in SI, and operations on them. Independent of file
// formats (read_motion.hpp) and meshes.
#pragma once

#include <vector>

namespace breach::motion {

/// Standard gravity [m/s2], the unit g of records.
inline constexpr double standard_gravity = 9.80665;

/// Samples at 0, dt, 2 dt, ...; linear between them, zero outside.
struct Series {
    double dt = 0.0;             ///< [s], > 0
    std::vector<double> values;  ///< [m/s2], [m/s] or [m]

    double duration() const;
};

/// Value at time t [s] by linear interpolation.
double value_at(const Series& series, double t);

/// Largest absolute value.
double peak(const Series& series);

/// All values times the factor that gives the peak `wanted`. Zeros stay zero.
Series scaled_to_peak(Series series, double wanted);

/// Integral over time by the trapezoidal rule, zero at the first sample.
Series integral(const Series& series);

/// Time derivative by differences, one-sided at the ends.
Series derivative(const Series& series);

/// Values at ascending times, as equally spaced samples from 0 to the last time.
Series equally_spaced(const std::vector<double>& times, const std::vector<double>& values,
                      double dt);

/// pi / (2 g) times the integral of a^2 (Arias 1970) [m/s]; acceleration in m/s2, trapezoidal rule.
double arias_intensity(const Series& acceleration);

/// Times at which 5 % and 95 % of the Arias intensity have arrived [s].
struct StrongPart {
    double begin;
    double end;
    double duration() const { return end - begin; }
};
StrongPart strong_part(const Series& acceleration);

/// Frequencies below which 2 % and 98 % of the motion's power lie, up to 50 Hz [Hz].
struct Band {
    double low;
    double high;
};
Band band(const Series& motion);

/// Residual motion at the end: zero for a base-corrected motion.
struct Baseline {
    double last_velocity;      ///< [m/s]
    double last_displacement;  ///< [m]
    double velocity_share;     ///< |last velocity| over the peak velocity [-]
};
Baseline baseline(const Series& acceleration);

/// The acceleration minus the line c_0 + c_1 t that makes the final velocity and displacement zero.
Series base_corrected(Series acceleration);

}  // namespace breach::motion
