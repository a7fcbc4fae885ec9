// Inside core/check only: whether a segment of the scene (a support, a pressure boundary) will
// contain mesh nodes, before the mesh exists. Nodes are certain at a region's vertices and along
// its sides.
#pragma once

#include <string>

#include "core/check/section.hpp"

namespace breach::check {

/// Whether the segment runs along a side of the region, through one of its vertices, or through a
/// structured (block) region, whose inner nodes it may contain.
bool touches(const scene::Region& region, const Side& segment, double tolerance);
bool may_hold_nodes(const scene::Scene& scene, const Side& segment, double tolerance);

/// Length of the segment on sides of regions [m]. A side that two regions share counts twice.
double length_on_sides(const scene::Scene& scene, const Side& segment, double tolerance);

/// "runs 0.01 m beside the section": why the segment contains no node.
std::string how_it_misses(const scene::Scene& scene, const Side& segment);

}  // namespace breach::check
