// Whether the mass that fails comes near the section's upstream end: what stands there, columns or
// supports, is no ground, and holds or loads it as no ground would.
#pragma once

#include <optional>

#include "fem_solver/monitors/failure_surface.hpp"
#include "fem_solver/monitors/watch.hpp"

namespace breach::fem {

/// Nothing where the section has no upstream end (its ground is level from side to side), or where
/// nothing fails: no failure surface, and no soil that moved by 5 % of the section's height.
/// excess_max: [nodes of the body] largest excess pore pressure; empty in dry soil [Pa]
std::optional<fault::Flag> upstream_wall(const scene::Fem& fem, const Model& model,
                                         const Motion& motion, const Beginning& beginning,
                                         const FailureSurfaces& surfaces,
                                         std::span<const double> excess_max);

}  // namespace breach::fem
