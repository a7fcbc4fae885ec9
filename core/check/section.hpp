// Inside core/check only: questions about the cross-section as it is drawn.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/geometry/polyline.hpp"
#include "core/scene/scene.hpp"

namespace breach::check {

using geometry::level_at;
using geometry::straight_level_at;
using scene::Vec2;

/// "12.4", "(3, -5)": a number as the scene would write it.
std::string text(double value);
std::string text(const Vec2& point);
std::string metres(double value);

std::string region_pointer(std::size_t region, const std::string& below = "");

/// The region's material; none when the scene does not have it.
const scene::Material* material_of(const scene::Scene& scene, const scene::Region& region);

/// Box around all polygons. The scene has soil.
geometry::Box extent(const scene::Scene& scene);

/// Length of the region's elements as far as the scene says it, over its area for a block [m].
double element_size(const scene::Region& region);
double least_element_size(const scene::Scene& scene);
double largest_element_size(const scene::Scene& scene);

/// Two points of a ring that follow each other.
struct Side {
    Vec2 a, b;
};
std::vector<Side> sides_of(const geometry::Polygon& polygon);

/// From a place to the nearest soil; 0 inside [m].
double distance_to_soil(const scene::Scene& scene, const Vec2& place);
bool in_soil(const scene::Scene& scene, const Vec2& place, double tolerance);

/// Greatest height of the line over a point of the polygon, and where. The line's level beyond its
/// ends is what `level` says.
struct Depth {
    double below;  ///< positive: the polygon reaches below the line [m]
    Vec2 place;
};
using Level = double (*)(const std::vector<Vec2>&, double);
Depth deepest_below(const geometry::Polygon& polygon, const std::vector<Vec2>& line, Level level);
/// The same over all regions.
Depth deepest_below(const scene::Scene& scene, const std::vector<Vec2>& line, Level level);

/// Levels of the soil over x, from the top down: [top, bottom] of each region that lies there.
struct Stratum {
    double top, bottom;
    std::size_t region;
};
std::vector<Stratum> strata_at(const scene::Scene& scene, double x);

/// Abscissae between which all borders are straight, ascending.
std::vector<double> abscissae(const scene::Scene& scene);

/// The ground's levels over a range, lowest and highest; infinite where there is none.
struct Levels {
    double lowest = std::numeric_limits<double>::infinity();
    double highest = -std::numeric_limits<double>::infinity();
};
Levels ground_over(const scene::Scene& scene, double from, double to);

}  // namespace breach::check
