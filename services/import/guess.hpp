// Guesses entries that a scene needs and a drawing lacks, from the ground line: the search for slip
// surfaces, the element size, the grid of a runout. The report marks them as guesses.
#pragma once

#include <array>
#include <optional>

#include "core/geometry/section.hpp"
#include "services/import/heal.hpp"

namespace breach::importing {

/// For the functions of core/geometry/section.hpp.
geometry::Outlines outlines_of(const std::vector<Soil>& soils);

geometry::Box box_of(const std::vector<Soil>& soils);

/// Upper boundary of the soils from left to right, without stretches that have no soil [m].
std::vector<Vec2> ground_of(const std::vector<Soil>& soils);

/// The highest gap of air between two soils.
struct Void {
    Vec2 at;
    double height;             ///< [m]
    std::size_t above, below;  ///< indices of soils
};
/// Nothing: no gap is higher than `tolerance` [m].
std::optional<Void> highest_void(const std::vector<Soil>& soils, double tolerance);

/// The slope with the greatest fall from a high point to the foot on one side of it. The foot is
/// where the face ends, even if the ground beyond keeps falling.
struct Slope {
    Vec2 crest, toe;
    double fall() const { return crest.y() - toe.y(); }
};
/// Nothing: the ground is level (it falls by less than a hundredth of its length).
std::optional<Slope> slope_of(const std::vector<Vec2>& ground);

/// Whether the top is level and the bottom slopes: depths were read as levels.
bool looks_upside_down(const std::vector<Soil>& soils);

struct Ranges {
    std::array<double, 2> entry, exit;  ///< x [m]
};
/// Entry: from behind the crest to a quarter of the slope. Exit: from the middle of the slope to
/// beyond the toe.
Ranges ranges_of(const Slope& slope, const std::vector<Vec2>& ground);

/// Rigid ground of a runout where none is drawn: the section's lower edge, then the natural ground.
struct Terrain {
    std::vector<Vec2> line;  ///< from left to right, to ten falls of the slope beyond the toe [m]
    std::string from;        ///< how it was chosen, for the report
};
/// `drawn`: the ground line, which counts beyond the section's right end; empty: none. Needs a
/// ground with a slope to the right.
Terrain guessed_terrain(const std::vector<Soil>& soils, const std::vector<Vec2>& drawn);

/// About a fifteenth of the fall, rounded to 1, 2 or 5 times a power of ten [m].
double element_size_for(double height);
/// A twentieth of the fall, rounded down to two digits [m]: the cells of "breach new".
double cell_size_for(double height);

}  // namespace breach::importing
