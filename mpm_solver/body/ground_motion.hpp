// Motion of the ground below the runout, on the runout's clock. The grid moves with it: floor,
// terrain and walls are at rest in this frame, and minus the ground's acceleration acts on the
// soil.
// Simulation asks for the acceleration before each step. The frame is rigid: soil does not act back
// on the ground (docs/reference/methods/earthquake_in_the_runout.md).
#pragma once

#include <vector>

#include "core/exchange/base_motion.hpp"

namespace breach::mpm {

/// Linear between the velocity samples, so impulses are exact for any time step; constant velocity,
/// and no force, before the first and after the last sample.
class GroundMotion {
  public:
    /// `base` must have samples; `transfer_time`: start of the runout on their clock [s].
    GroundMotion(exchange::BaseMotion base, double transfer_time);

    /// Relative to far rock, at time t of the runout [m/s].
    double velocity(double t) const;
    /// Mean acceleration from t to t + dt [m/s2].
    double acceleration(double t, double dt) const;
    /// From the beginning of the shaking to time t of the runout [m].
    double displacement(double t) const;
    /// Time of the last sample on the runout's clock [s]; <= 0: no shaking in the runout.
    double end() const;
    /// After time 0 of the runout: largest acceleration between two samples [m/s2], and largest
    /// change of velocity since time 0 [m/s].
    double peak_acceleration() const;
    double largest_swing() const;

    const exchange::BaseMotion& base() const { return base_; }
    double transfer_time() const { return transfer_time_; }

  private:
    /// The first sample at or after time 0 of the runout.
    std::size_t first_sample() const;

    exchange::BaseMotion base_;
    double transfer_time_;
};

}  // namespace breach::mpm
