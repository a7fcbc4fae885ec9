// Queries on a cross-section as drawn: soil, ground level, strata.
#pragma once

#include "core/geometry/polygon.hpp"
#include "core/geometry/polyline.hpp"

namespace breach::geometry {

/// Polygons of a section's regions, in their order, not copied. An empty polygon is no soil.
using Outlines = std::vector<const Polygon*>;

template <class Regions, class Polygon>
Outlines outlines_of(const Regions& regions, Polygon polygon) {
    Outlines outlines;
    for (const auto& each : regions) outlines.push_back(&(each.*polygon));
    return outlines;
}

/// Bounding box of all regions; inverted (low > high) if there is no soil.
Box extent(const Outlines& outlines);

bool in_soil(const Outlines& outlines, const Vec2& place, double tolerance = 0.0);
/// Distance from a place to the nearest soil; 0 inside [m].
double distance_to_soil(const Outlines& outlines, const Vec2& place);

/// Heights at which the border crosses the vertical through x, ascending. An edge counts at its
/// left end only: a vertex on the vertical gives one crossing, or none where the border turns back.
std::vector<double> crossings(const Polygon& polygon, double x);

/// Levels of the soil at x, from the top down: [top, bottom] of each region.
struct Stratum {
    double top, bottom;
    std::size_t region;
};
std::vector<Stratum> strata_at(const Outlines& outlines, double x);

/// Range of the border's vertices at x, and whether a vertical side joins them.
struct Upright {
    double low, high;  ///< inverted (low > high) without vertices
    bool unbroken;
};
Upright upright_at(const Outlines& outlines, double x, double tolerance);

/// Highest soil at x; -infinity: there is none [m].
double ground_at(const Outlines& outlines, double x);

/// Greatest height of a line above a point of the soil, and where. `level` extrapolates the line.
struct Depth {
    double below;  ///< positive: the soil reaches below the line [m]
    Vec2 place;
};
Depth deepest_below(const Polygon& polygon, const std::vector<Vec2>& line, Level level);
Depth deepest_below(const Outlines& outlines, const std::vector<Vec2>& line, Level level);

/// Abscissae between which all borders are straight lines, ascending.
std::vector<double> abscissae(const Outlines& outlines);

/// Lowest and highest ground level over a range; infinite and inverted if there is no ground.
struct Levels {
    double lowest, highest;
};
Levels ground_over(const Outlines& outlines, double from, double to);

/// The ground surface between two abscissae, from left to right: one line per continuous piece.
std::vector<std::vector<Vec2>> ground_between(const Outlines& outlines, double from, double to);

}  // namespace breach::geometry
