// Arcs of polylines, and their replacement by chords. Pure geometry.
#pragma once

#include <cstddef>
#include <vector>

#include "core/mechanics/tensor.hpp"

namespace breach::importing {

using mechanics::Vec2;

struct Corner {
    Vec2 at = Vec2::Zero();  ///< drawing units
    double z = 0.0;
    double bulge = 0.0;  ///< of the arc to the next corner (points_on_arc)
    std::size_t line = 0;
};

/// An arc from angle `from` over `angle` [rad, positive counter-clockwise]: two halves, because the
/// bulge of a nearly full circle is nearly infinite.
std::vector<Corner> corners_of_arc(const Vec2& centre, double radius, double from, double angle);

/// Points strictly between `from` and `to` on the arc with this bulge (tangent of a quarter of its
/// angle, positive counter-clockwise). Chords deviate by at most `sagitta` [m], but there are at
/// most 512 of them.
std::vector<Vec2> points_on_arc(const Vec2& from, const Vec2& to, double bulge, double sagitta);

}  // namespace breach::importing
