#include "mpm_solver/body/overburden.hpp"

#include <algorithm>
#include <vector>

#include "core/geometry/section.hpp"

namespace breach::mpm {

namespace {

using geometry::Polygon;
using scene::Vec2;

double thickness_above(const Polygon& polygon, const Vec2& place) {
    // Ascending; between an even crossing and the next one the vertical is inside.
    const std::vector<double> heights = geometry::crossings(polygon, place.x());
    double thickness = 0.0;
    for (std::size_t k = 0; k + 1 < heights.size(); k += 2) {
        thickness += std::max(heights[k + 1] - std::max(heights[k], place.y()), 0.0);
    }
    return thickness;
}

}  // namespace

double overburden(const scene::Scene& scene, const Vec2& place) {
    double weight = 0.0;
    for (const scene::Region& region : scene.section.regions) {
        weight += scene.materials[region.material].density * scene.gravity *
                  thickness_above(region.polygon, place);
    }
    return weight;
}

mechanics::Voigt column_stress(double sigma_v, double nu) {
    const double beside = -nu / (1.0 - nu) * sigma_v;
    return {beside, -sigma_v, beside, 0.0};
}

}  // namespace breach::mpm
