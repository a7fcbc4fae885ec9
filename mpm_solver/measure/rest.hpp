// Whether the mobile soil is at rest, and if not, why. A stationary front is not enough: it is also
// stationary while a failing mass accelerates behind it, or while soil flows that does not affect
// the percentiles of x.
// Simulation::look asks after each row; course() ends the run on the answer.
#pragma once

#include <optional>
#include <string>

#include "mpm_solver/measure/energy.hpp"
#include "mpm_solver/measure/history.hpp"

namespace breach::mpm {

/// Connected cells (by sides or corners) of soil faster than some speed.
struct MovingBody {
    double mass = 0.0;   ///< [kg]
    double speed = 0.0;  ///< mass-weighted mean [m/s]
    double x = 0.0;      ///< of its centre of mass [m]
};

/// The heaviest such body of the given soils; mass 0: none.
MovingBody heaviest_moving_body(const Body& body, const std::vector<std::uint8_t>& counts,
                                double speed);

/// Reference for the final kinetic energy [J]: the energy released, but at least the mobile soil's
/// kinetic energy at rest.speed over rest.kinetic_share (a fall of 2.5 cm with the usual 0.005 and
/// 0.05 m/s).
double energy_scale(const scene::Rest& rest, double released, double mobile_mass);

/// Conditions of rest. Over the last rest.window: kinetic energy of the mobile soil below
/// rest.kinetic_share of the energy released and below rest.peak_share of its maximum so far, both
/// percentiles of the runout within rest.change. Now: no connected body above rest.body_share of
/// the mobile mass faster than rest.speed, and the time after rest.earliest. Empty: at rest;
/// otherwise the first violated condition, in words that continue "the soil moves: ".
///
/// The peak matters where a small kinetic energy is significant. Of the released energy, a
/// collapsing column has 22 % in motion at its peak, a softening slope 9 %, the Mochikoshi dam 4 %:
/// a twentieth of the peak is then 1.1 % to 0.2 %, with speeds of 22 % of the highest. A viscous
/// flow may never reach 0.5 %, and a mass that starts to slide is at its peak. Soil slower on
/// average than rest.speed may oscillate at its peak, like elastic soil that never slid, unless it
/// accelerates: a starting slide has grown within the window.
std::optional<std::string> why_moving(const History& history, const Energy& start, const Body& body,
                                      const std::vector<std::uint8_t>& counts,
                                      const scene::Rest& rest);

}  // namespace breach::mpm
