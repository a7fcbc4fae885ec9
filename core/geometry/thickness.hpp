// Thickness of a polygon: to count the cells and elements across it.
#pragma once

#include <optional>

#include "core/geometry/polygon.hpp"

namespace breach::geometry {

/// Thickness of a polygon [m], together with those that it touches and that count as one with it. The
/// local thickness at a place is the diameter of the largest disc inside the whole that covers the
/// place (Hildebrand & Rueegsegger 1997); half of the polygon's area lies where the whole is thicker
/// than the value returned, half where it is thinner. For a long band this is its thickness, for a
/// square its edge; thin wedges and necks with less than half of the area do not count. Accurate to a
/// few per cent.
double thickness_of(const Polygon& polygon, const std::vector<Polygon>& attached = {});

/// The same if it is less than a limit [m]; much faster where the polygon is thicker.
std::optional<double> thickness_below(double limit, const Polygon& polygon,
                                      const std::vector<Polygon>& attached = {});

/// Whether their borders share more than a point.
bool touch(const Polygon& a, const Polygon& b);

}  // namespace breach::geometry
