// Plane polygons of the cross-section: rings without the repeated last vertex, counter-clockwise.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/mechanics/tensor.hpp"

namespace breach::geometry {

using mechanics::Vec2;
using Polygon = std::vector<Vec2>;

/// Two successive vertices of a ring.
struct Side {
    Vec2 a, b;
};
std::vector<Side> sides_of(const Polygon& polygon);

/// Signed area [m2], positive when counter-clockwise.
double signed_area(const Polygon& polygon);
double area(const Polygon& polygon);
/// True inside or on the border (within `tolerance` [m]).
bool contains(const Polygon& polygon, const Vec2& point, double tolerance = 0.0);
double squared_distance_to_segment(const Vec2& point, const Vec2& from, const Vec2& to);
double distance_to_segment(const Vec2& point, const Vec2& from, const Vec2& to);

/// Why the ring is not a simple polygon (two edges cross, repeated vertex, no area); empty when it
/// is one.
std::optional<std::string> defect(const Polygon& polygon);
/// The part of the polygon to the left of the line from a to b; empty if none. The line may cut off
/// only one piece.
Polygon clipped_left(const Polygon& subject, const Vec2& a, const Vec2& b);
/// Area that two simple polygons share [m2].
double overlap_area(const Polygon& a, const Polygon& b);

struct Box {
    Vec2 low;
    Vec2 high;
};
Box bounding_box(const Polygon& polygon);

}  // namespace breach::geometry
