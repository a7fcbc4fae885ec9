// A circle's lower arc, or an arc cut by a floor (composite surface), as slip surface: the sliding
// mass above it, cut into vertical slices at every material boundary and ground vertex.
// The search cuts thousands of circles: hence slices that are allocated once, and no allocation in
// cut().
#pragma once

#include <vector>

#include "lem_tool/slices.hpp"

namespace breach::lem {

/// A circle's lower arc between its intersections with the ground or a crack's tip.
struct Surface {
    scene::Circle circle;
    double left;   ///< x [m]
    double right;  ///< x [m]
    CrackAt crack = CrackAt::none;

    double level(double x) const;  ///< y of the arc [m]
};

/// Intersections of a circle's lower arc with a straight line within (from, to), ascending.
struct Meeting {
    int count = 0;
    double x[2];
};
Meeting meet(const scene::Circle& circle, const Line& line, double from, double to);

/// Bishop's moment equilibrium is also valid on a floor, where the normal force has a moment. With
/// N = (W - S sin a) / cos a, the sum of W d = S r + N f becomes W h tan a = S h / cos a; on the
/// arc that is W d = S R. d, h: horizontal and vertical distance of the base's middle from the
/// centre, r = d sin a + h cos a, f = d cos a - h sin a.
///
/// Cuts the mass into about `wanted` slices of equal width, more if boundaries require it. Weight
/// and moment of arc segments are exact, their length to the fourth order of the angle; only the
/// base inclination is that of the chord. No allocation.
Cut cut(const Strata& strata, const std::vector<Soil>& soils, const Surface& surface, int wanted,
        Slices& slices);

}  // namespace breach::lem
