#include "mpm_solver/body/overburden.hpp"

#include <algorithm>
#include <vector>

namespace breach::mpm {

namespace {

using scene::Polygon;
using scene::Vec2;

/// Heights at which the border crosses the upright through x, ascending. Edges count at their left
/// end only, so a vertex on the upright is met once, or not at all where the border turns back.
std::vector<double> crossings(const Polygon& polygon, double x) {
    std::vector<double> heights;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Vec2& from = polygon[k];
        const Vec2& to = polygon[(k + 1) % polygon.size()];
        if ((from.x() <= x) == (to.x() <= x)) continue;
        heights.push_back(from.y() + (to.y() - from.y()) * (x - from.x()) / (to.x() - from.x()));
    }
    std::sort(heights.begin(), heights.end());
    return heights;
}

double thickness_above(const Polygon& polygon, const Vec2& place) {
    const std::vector<double> heights = crossings(polygon, place.x());
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
