// Weights of nonlocal softening, the same in FEM and MPM: Galavi & Schweiger (2010), with the weight
// 0 at the point itself. Method: docs/reference/methods/softening.md.
#pragma once

#include <cmath>

#include "core/materials/point.hpp"

namespace breach::materials {

/// Radius of the neighbourhood: the weight is 4e-4 of its peak.
constexpr double nonlocal_reach = 3.0;  // lengths

/// r exp(-(r / l)^2): 0 at the point itself, largest at 0.7 l.
inline double nonlocal_weight(double r, double length) {
    return r * std::exp(-(r / length) * (r / length));
}

/// Fully softened soil flows from this epsilon_q on: its strains do not describe a band and are not
/// shared.
inline double spent_strain(const Softening& softening) { return 5.0 * softening.epsilon_q_end; }

}  // namespace breach::materials
