// Flags a failing mass near the section's upstream end, where free-field columns or supports
// replace the ground.
// report_end asks once. The runout has a flag of the same name (mpm_solver/measure/ends.hpp).
#pragma once

#include <optional>

#include "fem_solver/monitors/watch.hpp"

namespace breach::fem {

/// None without an upstream end (level ground), or without failure: no failure surface, and no
/// displacement of 5 % of the section's height. surface_cuts_through: there is a failure surface.
/// excess_max: [nodes of the body] largest excess pore pressure [Pa]; empty if dry.
std::optional<fault::Flag> upstream_wall(const scene::Fem& fem, const Model& model,
                                         const Motion& motion, const Beginning& beginning,
                                         bool surface_cuts_through, std::size_t crest_node,
                                         std::span<const double> excess_max);

}  // namespace breach::fem
