// Whether the failing mass approaches the section's upstream end, where free-field columns or supports
// replace the ground.
#pragma once

#include <optional>

#include "fem_solver/monitors/watch.hpp"

namespace breach::fem {

/// Nothing where the section has no upstream end (its ground is level from side to side), or where
/// nothing fails: no failure surface, and no soil that moved by 5 % of the section's height.
/// surface_cuts_through: there is a failure surface (Reading::failure_surfaces).
/// excess_max: [nodes of the body] largest excess pore pressure; empty in dry soil [Pa]
std::optional<fault::Flag> upstream_wall(const scene::Fem& fem, const Model& model,
                                         const Motion& motion, const Beginning& beginning,
                                         bool surface_cuts_through, std::size_t crest_node,
                                         std::span<const double> excess_max);

}  // namespace breach::fem
