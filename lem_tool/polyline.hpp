// Polygonal slip surfaces: the sliding mass above one, cut into slices for Spencer's method.
// The counterpart of arc.hpp: both give the same Slices, and SliceMaker does not know the surface.
#pragma once

#include <vector>

#include "lem_tool/slices.hpp"

namespace breach::lem {

struct Polyline {
    std::vector<scene::Vec2> points;  ///< ascending in x, from ground to ground or crack tip [m]
    CrackAt crack = CrackAt::none;
};

/// Ends of a surface are on the ground, or the upper one at the crack's tip. On a vertical face, an
/// upper end is at its top, a lower one at its bottom.
enum class SurfaceEnd { upper, lower };
double end_level(const Strata& strata, double x, SurfaceEnd end);

/// Reference circle for moments, well above the polyline. Full equilibrium gives a factor of safety
/// that does not depend on it.
scene::Circle pivot_of(const Polyline& polyline);

/// Cuts the mass into about `wanted` slices, more if boundaries and vertices require it.
Cut cut(const Strata& strata, const std::vector<Soil>& soils, const Polyline& polyline,
        const scene::Circle& pivot, int wanted, Slices& slices);

}  // namespace breach::lem
