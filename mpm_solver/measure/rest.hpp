// Whether the mobile soil is at rest, and if not, why. A stationary front is not enough: it is also
// stationary while a failing mass gathers speed behind it, and while soil flows that does not affect
// the percentiles of x.
#pragma once

#include <optional>
#include <string>

#include "mpm_solver/measure/energy.hpp"
#include "mpm_solver/measure/history.hpp"

namespace breach::mpm {

/// Soil in cells that touch each other (sides or corners), all of it faster than some speed.
struct MovingBody {
    double mass = 0.0;   ///< [kg]
    double speed = 0.0;  ///< mass-weighted mean [m/s]
    double x = 0.0;      ///< of its centre of mass [m]
};

/// The heaviest body of the given soils; mass 0 when none is that fast.
MovingBody heaviest_moving_body(const Body& body, const std::vector<std::uint8_t>& counts,
                                double speed);

/// Reference for the kinetic energy at the end [J]: the energy released, and if that is small or
/// zero (a stable slope), the energy of which rest.kinetic_share is the mobile soil's energy at
/// rest.speed: a fall of 2.5 cm with the usual 0.005 and 0.05 m/s.
double energy_scale(const scene::Rest& rest, double released, double mobile_mass);

/// Over the last rest.window: kinetic energy of the mobile soil below rest.kinetic_share of the
/// energy released and below rest.peak_share of its largest so far, both percentiles of the runout
/// within rest.change; now: no connected body of more than rest.body_share of the mobile mass faster
/// than rest.speed; and the run older than rest.earliest. Empty: at rest; otherwise the first
/// violated condition, in words that continue "the soil moves: ".
///
/// The peak matters where a small kinetic energy is significant. A collapsing column has 22 % of the
/// released energy in motion at its peak, a softening slope 9 %, the dam of Mochikoshi 4 %: a
/// twentieth of the peak is then 1.1 % to 0.2 % of the release, and speeds are 22 % of the highest. A
/// viscous flow may never have 0.5 % in motion, and a mass that starts to slide is at its peak. Soil
/// that is slower than rest.speed on average may oscillate at its peak, like elastic soil that never
/// slid, unless it accelerates: a starting slide has grown within the window.
std::optional<std::string> why_moving(const History& history, const Energy& start, const Body& body,
                                      const std::vector<std::uint8_t>& counts,
                                      const scene::Rest& rest);

}  // namespace breach::mpm
