// A line given by its points from left to right: water table, phreatic line, terrain.
#pragma once

#include <optional>
#include <vector>

#include "core/mechanics/tensor.hpp"

namespace breach::geometry {

/// z of the cross product: positive where b points to the left of a.
inline double cross(const mechanics::Vec2& a, const mechanics::Vec2& b) {
    return a.x() * b.y() - a.y() * b.x();
}

/// Intersection of the straight lines a-b and c-d, with its parameters on both [-]. None if they
/// are parallel.
struct Crossing {
    mechanics::Vec2 at;
    double on_first, on_second;

    /// Inside both segments, their ends excluded.
    bool is_within() const {
        return on_first > 0.0 && on_first < 1.0 && on_second > 0.0 && on_second < 1.0;
    }
};
std::optional<Crossing> crossing(const mechanics::Vec2& a, const mechanics::Vec2& b,
                                 const mechanics::Vec2& c, const mechanics::Vec2& d);

/// Level at x of the straight line through two points [m].
double on_straight(const mechanics::Vec2& a, const mechanics::Vec2& b, double x);

/// Level of the line at x, linear between its points and horizontal beyond its ends [m]. At least
/// one point, ascending in x.
double level_at(const std::vector<mechanics::Vec2>& line, double x);

/// The same, but the first and the last part are extended straight beyond the ends.
double straight_level_at(const std::vector<mechanics::Vec2>& line, double x);

using Level = double (*)(const std::vector<mechanics::Vec2>&, double);

/// The share of the line's length in x that is steeper than `slope`, up or down [-]; 0 for fewer
/// than two points.
double share_steeper_than(double slope, const std::vector<mechanics::Vec2>& line);

}  // namespace breach::geometry
