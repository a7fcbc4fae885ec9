// Queries on a cross-section as drawn: where soil is, the ground level, the strata above a place.
#pragma once

#include "core/geometry/polygon.hpp"
#include "core/geometry/polyline.hpp"

namespace breach::geometry {

/// The polygons of a section's regions, in their order; an empty polygon is no soil. The polygons
/// are not copied.
using Outlines = std::vector<const Polygon*>;

template <class Regions, class Polygon>
Outlines outlines_of(const Regions& regions, Polygon polygon) {
    Outlines outlines;
    for (const auto& each : regions) outlines.push_back(&(each.*polygon));
    return outlines;
}

/// Box around all regions; inverted (low > high) without soil.
Box extent(const Outlines& outlines);

bool in_soil(const Outlines& outlines, const Vec2& place, double tolerance = 0.0);
/// From a place to the nearest soil; 0 inside [m].
double distance_to_soil(const Outlines& outlines, const Vec2& place);

/// Heights at which the border crosses the upright through x, ascending. Edges count at their left
/// end only, so a vertex on the upright is met once, or not at all where the border turns back.
std::vector<double> crossings(const Polygon& polygon, double x);

/// Levels of the soil over x, from the top down: [top, bottom] of each region that lies there.
struct Stratum {
    double top, bottom;
    std::size_t region;
};
std::vector<Stratum> strata_at(const Outlines& outlines, double x);

/// Levels between which the border has vertices at x, and whether it runs there as one vertical line.
struct Upright {
    double low, high;  ///< inverted (low > high) without vertices
    bool unbroken;
};
Upright upright_at(const Outlines& outlines, double x, double tolerance);

/// Highest soil at x; -infinity: there is none [m].
double ground_at(const Outlines& outlines, double x);

/// Greatest height of a line over a point of the soil, and where. `level` gives the line's level
/// beyond its ends.
struct Depth {
    double below;  ///< positive: the soil reaches below the line [m]
    Vec2 place;
};
Depth deepest_below(const Polygon& polygon, const std::vector<Vec2>& line, Level level);
Depth deepest_below(const Outlines& outlines, const std::vector<Vec2>& line, Level level);

/// Abscissae between which all borders are straight, ascending.
std::vector<double> abscissae(const Outlines& outlines);

/// Lowest and highest ground level over a range; infinite and inverted where there is no ground.
struct Levels {
    double lowest, highest;
};
Levels ground_over(const Outlines& outlines, double from, double to);

/// The upper border of the soil between two abscissae, from left to right: a line for each piece
/// without gap or step.
std::vector<std::vector<Vec2>> ground_between(const Outlines& outlines, double from, double to);

}  // namespace breach::geometry
