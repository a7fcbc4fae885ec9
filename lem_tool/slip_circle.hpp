// Circles and the ground: the sliding masses of a given circle, and the circles through two points
// of the ground.
#pragma once

#include <optional>
#include <vector>

#include "lem_tool/arc.hpp"
#include "lem_tool/strata.hpp"

namespace breach::lem {

/// Every mass above a circle's lower arc, from left to right, each with its crack at the higher
/// end. Masses shallower than the crack are left out.
std::vector<Surface> masses_of(const Strata& strata, const scene::Circle& circle);

/// y of the arc, or of the floor where that is higher [m].
double base_level(const Strata& strata, const Surface& surface, double x);

/// The surface cut off where the mass becomes as deep as the crack, coming from the upper end; none
/// if it never does. Without a crack in the strata it is the surface itself.
enum class UpperEnd { left, right };
std::optional<Surface> with_crack(const Strata& strata, const Surface& surface, UpperEnd upper);

/// Two points of the ground that a slip surface joins.
struct Ends {
    scene::Vec2 left;
    scene::Vec2 right;

    double half_chord() const { return 0.5 * (right - left).norm(); }
    /// The deepest arc: its centre is level with the higher end, so that it does not overhang
    /// [m].
    double largest_sagitta() const;
};

/// The circle whose lower arc joins the ends and bulges by `sagitta` [m] > 0 under their chord.
Surface surface_through(const Ends& ends, double sagitta);

/// Sagittas of the circles through the ends that touch a line: the one resting on it first [m].
struct Touching {
    int count = 0;
    double sagitta[2];
};
Touching touching(const Ends& ends, const Line& line);

}  // namespace breach::lem
