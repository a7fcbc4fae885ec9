// A circle's lower arc, or an arc cut by a floor (composite surface), as a slip surface: the sliding
// mass above it, cut into vertical slices at every material boundary and ground vertex.
#pragma once

#include <vector>

#include "lem_tool/slices.hpp"

namespace breach::lem {

/// A circle's lower arc between the two points where it meets the ground or a crack's foot.
struct Surface {
    scene::Circle circle;
    double left;   ///< x [m]
    double right;  ///< x [m]
    CrackAt crack = CrackAt::none;

    double level(double x) const;  ///< y of the arc [m]
};

/// Where a circle's lower arc meets a straight line within (from, to), ascending.
struct Meeting {
    int count = 0;
    double x[2];
};
Meeting meet(const scene::Circle& circle, const Line& line, double from, double to);

/// Why Bishop's balance keeps its form on a floor, where the normal force has a moment too: with
/// N = (W - S sin a) / cos a the sum of W d = S r + N f (d, h: base's middle beside and below the
/// centre, r = d sin a + h cos a, f = d cos a - h sin a) becomes W h tan a = S h / cos a, which on
/// the arc is W d = S R.
///
/// Cuts the mass into about `wanted` slices of equal width, more where boundaries require it. Arc
/// segments are exact in weight, moment and (to the fourth order of their angle) length; only the
/// base inclination is that of the chord. No allocation.
Cut cut(const Strata& strata, const std::vector<Soil>& soils, const Surface& surface, int wanted,
        Slices& slices);

}  // namespace breach::lem
