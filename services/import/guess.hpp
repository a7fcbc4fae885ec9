// What a drawing does not say and a scene needs: where a slip surface is searched, how large elements
// are, the grid of a runout. Each is a guess from the ground's line, and told as one.
#pragma once

#include <array>
#include <optional>

#include "core/geometry/section.hpp"
#include "services/import/heal.hpp"

namespace breach::importing {

/// For the questions of core/geometry/section.hpp.
geometry::Outlines outlines_of(const std::vector<Soil>& soils);

/// Upper border of the soils from left to right; pieces where nothing lies between are left out [m].
std::vector<Vec2> ground_of(const std::vector<Soil>& soils);

/// Air between soil and soil below it, where it is highest.
struct Void {
    Vec2 at;
    double height;             ///< [m]
    std::size_t above, below;  ///< indices of soils
};
/// None where nowhere more than `tolerance` [m].
std::optional<Void> highest_void(const std::vector<Soil>& soils, double tolerance);

/// The slope with the greatest fall between a height and the foot on one side of it: where its face
/// ends, though the ground beyond may fall on.
struct Slope {
    Vec2 crest, toe;
    double fall() const { return crest.y() - toe.y(); }
};
/// None where the ground is level (a fall below a hundredth of its length).
std::optional<Slope> slope_of(const std::vector<Vec2>& ground);

/// The top has no slope and the bottom has one: depths, positive downwards, taken for levels.
bool looks_upside_down(const std::vector<Soil>& soils);

struct Ranges {
    std::array<double, 2> entry, exit;  ///< x [m]
};
/// Upper ends from behind the crest to a quarter of the slope, lower ends from its middle to beyond
/// the toe.
Ranges ranges_of(const Slope& slope, const std::vector<Vec2>& ground);

/// About a fifteenth of the fall, as 1, 2 or 5 times a power of ten [m].
double element_size_for(double height);

}  // namespace breach::importing
