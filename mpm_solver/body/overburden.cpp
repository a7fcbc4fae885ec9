#include "mpm_solver/body/overburden.hpp"

#include <algorithm>
#include <vector>

#include "core/geometry/section.hpp"

namespace breach::mpm {

namespace {

using geometry::Polygon;
using scene::Vec2;

/// Also raises `top` to the polygon's highest soil there.
double thickness_above(const Polygon& polygon, const Vec2& place, double& top) {
    // Ascending; between an even crossing and the next one the vertical is inside.
    const std::vector<double> heights = geometry::crossings(polygon, place.x());
    double thickness = 0.0;
    for (std::size_t k = 0; k + 1 < heights.size(); k += 2) {
        thickness += std::max(heights[k + 1] - std::max(heights[k], place.y()), 0.0);
        top = std::max(top, heights[k + 1]);
    }
    return thickness;
}

}  // namespace

double overburden(const scene::Scene& scene, const scene::StandingWater& water, const Vec2& place) {
    double weight = 0.0, top = place.y();
    for (const scene::Region& region : scene.section.regions) {
        weight += scene.materials[region.material].density * scene.gravity *
                  thickness_above(region.polygon, place, top);
    }
    if (water.is_there()) weight -= water.pressure(place) - water.pressure({place.x(), top});
    return weight;
}

mechanics::Voigt column_stress(double sigma_v, double nu) {
    const double beside = -nu / (1.0 - nu) * sigma_v;
    return {beside, -sigma_v, beside, 0.0};
}

}  // namespace breach::mpm
