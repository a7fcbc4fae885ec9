// Overlap of soil: points may cluster although every integrated volume is right
// (docs/reference/methods/mpm.md, *One step*).
// The meter is used in two ways: measure() reports at each telemetry line, mark() and
// hold_gaps_to_room() change points every few steps before the step (Simulation::advance).
#pragma once

#include <vector>

#include "mpm_solver/body/body.hpp"

namespace breach::mpm {

/// Steps between two updates of the correction: soil moves by a small part of a cell.
constexpr std::int64_t steps_between_marks = 8;

class OverlapMeter {
  public:
    explicit OverlapMeter(const Body& body, double thickness);

    /// Volume-weighted mean over the mobile points of max(0, fill - 1) at their nodes, fill_i =
    /// sum_p V_p N_i / capacity_i of all points [-]. mobile: [regions].
    double measure(const Body& body, const std::vector<std::uint8_t>& mobile) const;

    /// Sets every point's excess: the mean over its nodes of max(0, fill - 1 - tolerance) [-].
    void mark(Body& body, double tolerance);

    /// Closes gaps without space. Debris that lands between other points is not compressed there,
    /// so its gap would stay although neighbours have filled it: an opened point keeps at most V /
    /// fill of its nodes.
    void hold_gaps_to_room(Body& body);

  private:
    /// [nodes] sum_p V_p N_i / capacity_i [-].
    void fill_nodes(const Body& body, std::vector<double>& fill) const;

    /// Integral of the nodal weight over the domain, per column [m].
    std::vector<double> capacity_x_;
    std::vector<double> capacity_y_;
    double thickness_;
    std::vector<double> fill_;        ///< [nodes]; empty without correction and gap closure [-]
    std::vector<double> fill_about_;  ///< [points]; empty without gap closure [-]
};

}  // namespace breach::mpm
