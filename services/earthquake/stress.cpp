// Mean stress of each layer, from which its residual strength follows. Overburden of one density:
// a stress analysis would need the scene that is being made.
#include "services/earthquake/stress.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <map>

#include "core/geometry/polyline.hpp"
#include "services/earthquake/soils.hpp"

namespace breach::earthquake {

namespace {

/// Vertical effective stress below the ground and the phreatic line [kPa].
double sigma_v0_at(const Vec2& place, const Overburden& above) {
    const double ground = geometry::level_at(above.ground, place.x());
    const double water = std::min(geometry::level_at(above.phreatic, place.x()), ground);
    const double pressure = std::max(0.0, water - place.y()) * water_density;
    return (above.density * (ground - place.y()) - pressure) * g / 1e3;
}

}  // namespace

double largest_sigma_v0(const Polygon& polygon, const Overburden& above) {
    double largest = 0.0;
    for (const Vec2& each : polygon) largest = std::max(largest, sigma_v0_at(each, above));
    return largest;
}

void add(Sum& sum, const Polygon& polygon, const Overburden& above, double from) {
    // Points on a grid rather than integration over the polygon, which may be cut by the ground
    // in any shape.
    constexpr int lines = 40;
    const geometry::Box box = geometry::bounding_box(polygon);
    const Vec2 size = box.high - box.low;
    const double cell = size.x() * size.y() / (lines * lines);
    for (int i = 0; i < lines; ++i) {
        for (int j = 0; j < lines; ++j) {
            const Vec2 share{(i + 0.5) / lines, (j + 0.5) / lines};
            const Vec2 place = box.low + size.cwiseProduct(share);
            if (place.x() < from || !geometry::contains(polygon, place)) continue;
            sum.stress_area += cell * sigma_v0_at(place, above);
            sum.area += cell;
        }
    }
}

void find_stresses(std::vector<Region>& regions, const Overburden& above, double from) {
    constexpr double everywhere = -std::numeric_limits<double>::infinity();
    std::map<int, std::array<Sum, 2>> sums;
    for (const Region& each : regions) {
        if (each.layer == 0) continue;
        auto& [sliding, whole] = sums[each.layer];
        add(sliding, each.polygon, above, from);
        add(whole, each.polygon, above, everywhere);
    }
    for (Region& each : regions) {
        if (each.layer == 0) continue;
        const auto& [sliding, whole] = sums[each.layer];
        const Sum& sum = sliding.area > 0.0 ? sliding : whole;
        each.sigma_v0_kPa = sum.stress_area / sum.area;
    }
}

}  // namespace breach::earthquake
