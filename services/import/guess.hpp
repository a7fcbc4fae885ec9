// Entries that a scene needs and a drawing lacks: where a slip surface is searched, the element size,
// the grid of a runout. Each is guessed from the ground's line, and reported as a guess.
#pragma once

#include <array>
#include <optional>

#include "core/geometry/section.hpp"
#include "services/import/heal.hpp"

namespace breach::importing {

/// For the queries of core/geometry/section.hpp.
geometry::Outlines outlines_of(const std::vector<Soil>& soils);

/// Upper border of the soils from left to right; stretches without soil are left out [m].
std::vector<Vec2> ground_of(const std::vector<Soil>& soils);

/// The highest gap of air between soil and soil below it.
struct Void {
    Vec2 at;
    double height;             ///< [m]
    std::size_t above, below;  ///< indices of soils
};
/// None where no gap is higher than `tolerance` [m].
std::optional<Void> highest_void(const std::vector<Soil>& soils, double tolerance);

/// The slope with the greatest fall between a height and the foot on one side of it: the foot is
/// where its face ends, even if the ground beyond keeps falling.
struct Slope {
    Vec2 crest, toe;
    double fall() const { return crest.y() - toe.y(); }
};
/// None where the ground is level (a fall below a hundredth of its length).
std::optional<Slope> slope_of(const std::vector<Vec2>& ground);

/// The top has no slope and the bottom has one: depths, positive downwards, read as levels.
bool looks_upside_down(const std::vector<Soil>& soils);

struct Ranges {
    std::array<double, 2> entry, exit;  ///< x [m]
};
/// Upper ends from behind the crest to a quarter of the slope, lower ends from its middle to beyond
/// the toe.
Ranges ranges_of(const Slope& slope, const std::vector<Vec2>& ground);

/// About a fifteenth of the fall, as 1, 2 or 5 times a power of ten [m].
double element_size_for(double height);
/// A twentieth of the fall, rounded down to two digits [m]: the cells of "breach new".
double cell_size_for(double height);

}  // namespace breach::importing
