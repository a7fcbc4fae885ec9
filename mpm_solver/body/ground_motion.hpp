// Motion of the ground beneath the runout, on the runout's clock. The grid moves with it (a moving frame):
// floor, terrain and walls are at rest there, and minus the ground's acceleration acts on the soil.
#pragma once

#include <vector>

#include "core/exchange/base_motion.hpp"

namespace breach::mpm {

/// Linear between the samples of the velocity, so impulses are exact for any time step; before the
/// first and after the last one the velocity is constant, and no force acts.
class GroundMotion {
  public:
    /// `base` has samples; `transfer_time`: start of the runout's clock on their clock [s].
    GroundMotion(exchange::BaseMotion base, double transfer_time);

    /// Against far rock, at time t of the runout [m/s].
    double velocity(double t) const;
    /// Mean acceleration from t to t + dt, the change of velocity over dt [m/s2].
    double acceleration(double t, double dt) const;
    /// Since the shaking began, until time t of the runout [m].
    double displacement(double t) const;
    /// Time of the last sample on the runout's clock [s]; <= 0: no shaking during the runout.
    double end() const;
    /// From time 0 of the runout on: largest acceleration between two samples [m/s2] and largest
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
