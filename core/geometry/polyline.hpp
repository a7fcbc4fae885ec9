// A line given by its points from left to right: water table, phreatic line, terrain.
#pragma once

#include <vector>

#include "core/mechanics/tensor.hpp"

namespace breach::geometry {

/// z of the cross product: positive where b points to the left of a.
inline double cross(const mechanics::Vec2& a, const mechanics::Vec2& b) {
    return a.x() * b.y() - a.y() * b.x();
}

/// Level of the line at x: straight between its points, level beyond its ends [m]. At least one
/// point, ascending in x.
double level_at(const std::vector<mechanics::Vec2>& line, double x);

/// The same, but the first and the last part go on straight beyond the ends.
double straight_level_at(const std::vector<mechanics::Vec2>& line, double x);

/// The share of the line's length in x that is steeper than `slope`, up or down [-]; 0 for fewer
/// than two points.
double share_steeper_than(double slope, const std::vector<mechanics::Vec2>& line);

}  // namespace breach::geometry
