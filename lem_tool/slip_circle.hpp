// Circles and the ground: the sliding masses of a given circle, and the circles through two points
// of the ground.
// masses_of serves given circles (facts.cpp), the rest the search.
#pragma once

#include <optional>
#include <vector>

#include "lem_tool/arc.hpp"
#include "lem_tool/strata.hpp"

namespace breach::lem {

/// Every mass above a circle's lower arc, from left to right, with its crack at the higher end.
/// Omits masses shallower than the crack.
std::vector<Surface> masses_of(const Strata& strata, const scene::Circle& circle);

/// y of the arc, or of the floor if that is higher [m].
double base_level(const Strata& strata, const Surface& surface, double x);

/// The surface, ended at the crack: where the depth of the mass, from the upper end, reaches that
/// of the crack; none if it never does. Unchanged if the strata have no crack.
enum class UpperEnd { left, right };
std::optional<Surface> with_crack(const Strata& strata, const Surface& surface, UpperEnd upper);

/// Two points of the ground that a slip surface joins.
struct Ends {
    scene::Vec2 left;
    scene::Vec2 right;

    double half_chord() const { return 0.5 * (right - left).norm(); }
    /// Sagitta of the deepest arc without overhang: its centre is level with the higher end [m].
    double largest_sagitta() const;
};

/// The circle through the ends whose lower arc has this sagitta > 0 [m].
Surface surface_through(const Ends& ends, double sagitta);

/// Sagittas of the circles through the ends that are tangent to a line, first the one above it [m].
struct Touching {
    int count = 0;
    double sagitta[2];
};
Touching touching(const Ends& ends, const Line& line);

}  // namespace breach::lem
