// How thick a polygon is: what cells and elements across it are counted by.
#pragma once

#include <optional>

#include "core/geometry/polygon.hpp"

namespace breach::geometry {

/// How thick a polygon is [m], together with those that it touches and that count as one with it.
/// The local thickness at a place is the diameter of the largest disc inside the whole that covers
/// the place (Hildebrand & Rueegsegger 1997); half of the polygon's area lies where the whole is
/// thicker than the value returned, half where it is thinner. A long band's own thickness, a
/// square's edge; thin wedges and necks that hold less than half of the area do not count. Within a
/// few per cent.
double thickness_of(const Polygon& polygon, const std::vector<Polygon>& attached = {});

/// The same where it is less than a limit [m]; that it is more is found out much faster.
std::optional<double> thickness_below(double limit, const Polygon& polygon,
                                      const std::vector<Polygon>& attached = {});

/// Whether their borders share more than a point.
bool touch(const Polygon& a, const Polygon& b);

}  // namespace breach::geometry
