// Excess pore pressure at the nodes of a mesh, without the part that alternates from node to node.
// For r_u, liquefied depth, criteria, zones and the transfer.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/mechanics/tensor.hpp"

namespace breach::mechanics {

/// p - p_0 [Pa] at each node: mean of the surrounding elements' means, weighted by area. A pressure
/// (1, -1, 1, -1) at the corners cancels exactly. Elements with p_0 = 0 at all corners are dry and
/// do not count; nodes with dry elements only get 0. nodes: undeformed [m]; p, p_0: [nodes] present
/// and initial pore pressure [Pa]
std::vector<double> nodal_excess_pressure(std::span<const Vec2> nodes,
                                          std::span<const std::array<std::int32_t, 4>> quads,
                                          std::span<const double> p, std::span<const double> p_0);

}  // namespace breach::mechanics
