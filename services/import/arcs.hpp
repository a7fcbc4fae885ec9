// Replaces arcs by chords. Pure geometry.
#pragma once

#include <vector>

#include "core/mechanics/tensor.hpp"

namespace breach::importing {

using mechanics::Vec2;

/// Points strictly between `from` and `to` on the arc with this bulge (tangent of a quarter of its
/// angle, positive counter-clockwise). Chords deviate by at most `sagitta` [m], but there are at
/// most 512 of them.
std::vector<Vec2> points_on_arc(const Vec2& from, const Vec2& to, double bulge, double sagitta);

}  // namespace breach::importing
