// Slip surfaces of straight pieces: the sliding mass above one, cut into slices for Spencer's
// method. Bishop's needs a circle.
#pragma once

#include <vector>

#include "lem_tool/slices.hpp"

namespace breach::lem {

struct Polyline {
    std::vector<scene::Vec2> points;  ///< ascending in x, from ground to ground or crack's foot [m]
    CrackAt crack = CrackAt::none;
};

/// Ends of a surface over x: on the ground, the upper end at the foot of the crack. On a vertical
/// face an upper end is at the head, a lower one at the foot.
enum class SurfaceEnd { upper, lower };
double end_level(const Strata& strata, double x, SurfaceEnd end);

/// A circle for moments, well above the polyline. The factor of safety by equilibrium of forces and
/// moments does not depend on it.
scene::Circle pivot_of(const Polyline& polyline);

/// Cuts the mass into about `wanted` slices, more where boundaries and vertices require it.
Cut cut(const Strata& strata, const std::vector<Soil>& soils, const Polyline& polyline,
        const scene::Circle& pivot, int wanted, Slices& slices);

}  // namespace breach::lem
