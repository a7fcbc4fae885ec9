// Excess pore pressure at the nodes of a mesh, without the part that alternates from node to node:
// for r_u, liquefied depth, criteria, zones and the transfer.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/mechanics/tensor.hpp"

namespace breach::mechanics {

/// p - p_0 [Pa] at each node as the mean of the surrounding elements' own means, weighted by their
/// areas: a pressure (1, -1, 1, -1) at the corners drops out exactly. Only elements with p_0 != 0
/// at a corner count, the others are dry; nodes of dry elements alone have 0.
/// nodes: undeformed [m]; p, p_0: [nodes] pore pressure now and at first [Pa]
std::vector<double> nodal_excess_pressure(std::span<const Vec2> nodes,
                                          std::span<const std::array<std::int32_t, 4>> quads,
                                          std::span<const double> p, std::span<const double> p_0);

}  // namespace breach::mechanics
