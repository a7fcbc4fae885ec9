// Thickness of a polygon, to count the cells or elements across it.
#pragma once

#include <optional>

#include "core/geometry/polygon.hpp"

namespace breach::geometry {

/// Thickness of a polygon [m], joined with the `attached` polygons that it touches. The local
/// thickness at a place is the diameter of the largest inscribed disc that covers the place
/// (Hildebrand & Rueegsegger 1997); this is its median over the polygon's area. For a long band it
/// is the thickness, for a square the edge; wedges and necks with less than half of the area do not
/// count. Accurate to a few per cent.
double thickness_of(const Polygon& polygon, const std::vector<Polygon>& attached = {});

/// The same if it is less than `limit` [m], else none; much faster for thick polygons.
std::optional<double> thickness_below(double limit, const Polygon& polygon,
                                      const std::vector<Polygon>& attached = {});

/// Whether their borders share more than a point.
bool touch(const Polygon& a, const Polygon& b);

}  // namespace breach::geometry
