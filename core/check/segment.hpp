// Inside core/check only: whether a segment of the scene (a support, a boundary of pressure) will
// find nodes of a mesh that does not exist yet. Nodes are certain at a region's vertices and along
// its sides.
#pragma once

#include <string>

#include "core/check/section.hpp"

namespace breach::check {

/// Whether the segment runs along a side of the region, through one of its vertices, or through a
/// region with nodes in rows (a block), where it may meet some.
bool touches(const scene::Region& region, const Side& segment, double tolerance);
bool may_hold_nodes(const scene::Scene& scene, const Side& segment, double tolerance);

/// Length of the segment that lies on sides of regions, counted once per region [m].
double length_on_sides(const scene::Scene& scene, const Side& segment, double tolerance);

/// "runs 0.01 m beside the section", for a segment without nodes.
std::string how_it_misses(const scene::Scene& scene, const Side& segment);

}  // namespace breach::check
