#include "core/check/section.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "core/check/findings.hpp"

namespace breach::check {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double along(const Side& side, double x) {
    return side.a.y() + (side.b.y() - side.a.y()) * (x - side.a.x()) / (side.b.x() - side.a.x());
}

}  // namespace

std::string text(double value) {
    char words[32];
    std::snprintf(words, sizeof words, "%.6g", value);
    return words;
}

std::string text(const Vec2& point) {
    char words[64];
    std::snprintf(words, sizeof words, "(%.6g, %.6g)", point.x(), point.y());
    return words;
}

std::string metres(double value) { return text(value) + " m"; }

std::string region_pointer(std::size_t region, const std::string& below) {
    return "/section/regions/" + std::to_string(region) + below;
}

const scene::Material* material_of(const scene::Scene& scene, const scene::Region& region) {
    return region.material < scene.materials.size() ? &scene.materials[region.material] : nullptr;
}

bool has_soil(const scene::Scene& scene) {
    return std::ranges::any_of(scene.section.regions,
                               [](const scene::Region& each) { return !each.polygon.empty(); });
}

geometry::Box extent(const scene::Scene& scene) {
    geometry::Box all{Vec2::Constant(infinity), Vec2::Constant(-infinity)};
    for (const scene::Region& each : scene.section.regions) {
        if (each.polygon.empty()) continue;
        const geometry::Box box = geometry::bounding_box(each.polygon);
        all = {all.low.cwiseMin(box.low), all.high.cwiseMax(box.high)};
    }
    return all;
}

double element_size(const scene::Region& region) {
    const int elements = region.divisions[0] * region.divisions[1];
    if (region.mesh == scene::RegionMesh::block && elements > 0)
        return std::sqrt(geometry::area(region.polygon) / elements);
    if (region.element_size > 0.0) return region.element_size;
    const geometry::Box box = geometry::bounding_box(region.polygon);
    return 0.1 * (box.high - box.low).minCoeff();
}

double least_element_size(const scene::Scene& scene) {
    double least = infinity;
    for (const scene::Region& each : scene.section.regions)
        if (!each.polygon.empty()) least = std::min(least, element_size(each));
    return least;
}

double largest_element_size(const scene::Scene& scene) {
    double largest = 0.0;
    for (const scene::Region& each : scene.section.regions)
        if (!each.polygon.empty()) largest = std::max(largest, element_size(each));
    return largest;
}

std::vector<Side> sides_of(const geometry::Polygon& polygon) {
    std::vector<Side> sides;
    for (std::size_t i = 0; i < polygon.size(); ++i)
        sides.push_back({polygon[i], polygon[(i + 1) % polygon.size()]});
    return sides;
}

double distance_to_soil(const scene::Scene& scene, const Vec2& place) {
    if (in_soil(scene, place, 0.0)) return 0.0;
    double least = infinity;
    for (const scene::Region& each : scene.section.regions)
        for (const Side& side : sides_of(each.polygon))
            least = std::min(least, geometry::distance_to_segment(place, side.a, side.b));
    return least;
}

bool in_soil(const scene::Scene& scene, const Vec2& place, double tolerance) {
    return std::ranges::any_of(scene.section.regions, [&](const scene::Region& each) {
        return !each.polygon.empty() && geometry::contains(each.polygon, place, tolerance);
    });
}

Depth deepest_below(const geometry::Polygon& polygon, const std::vector<Vec2>& line, Level level) {
    Depth deepest{-infinity, Vec2::Zero()};
    const auto look = [&](const Vec2& place) {
        const double below = level(line, place.x()) - place.y();
        if (below > deepest.below) deepest = {below, place};
    };
    // Both are straight between the polygon's vertices and the line's kinks.
    for (const Side& side : sides_of(polygon)) {
        look(side.a);
        const auto [left, right] = std::minmax(side.a.x(), side.b.x());
        for (const Vec2& kink : line)
            if (kink.x() > left && kink.x() < right) look({kink.x(), along(side, kink.x())});
    }
    return deepest;
}

Depth deepest_below(const scene::Scene& scene, const std::vector<Vec2>& line, Level level) {
    Depth deepest{-infinity, Vec2::Zero()};
    for (const scene::Region& each : scene.section.regions) {
        if (each.polygon.empty()) continue;
        const Depth here = deepest_below(each.polygon, line, level);
        if (here.below > deepest.below) deepest = here;
    }
    return deepest;
}

std::vector<Stratum> strata_at(const scene::Scene& scene, double x) {
    std::vector<Stratum> strata;
    for (std::size_t r = 0; r < scene.section.regions.size(); ++r) {
        std::vector<double> levels;
        for (const Side& side : sides_of(scene.section.regions[r].polygon)) {
            const auto [left, right] = std::minmax(side.a.x(), side.b.x());
            if (x > left && x < right) levels.push_back(along(side, x));
        }
        std::ranges::sort(levels, std::greater<>());
        for (std::size_t i = 0; i + 1 < levels.size(); i += 2)
            strata.push_back({levels[i], levels[i + 1], r});
    }
    std::ranges::sort(strata, std::greater<>(), &Stratum::top);
    return strata;
}

std::vector<double> abscissae(const scene::Scene& scene) {
    std::vector<double> xs;
    for (const scene::Region& each : scene.section.regions)
        for (const Vec2& vertex : each.polygon) xs.push_back(vertex.x());
    std::ranges::sort(xs);
    const double same = 1e-9 * (xs.back() - xs.front());
    const auto repeated =
        std::ranges::unique(xs, [&](double a, double b) { return b - a <= same; });
    xs.erase(repeated.begin(), repeated.end());
    return xs;
}

Levels ground_over(const scene::Scene& scene, double from, double to) {
    const geometry::Box box = extent(scene);
    const double near = 1e-6 * (box.high.x() - box.low.x());
    std::vector<double> xs = abscissae(scene);
    xs.push_back(from);
    xs.push_back(to);
    Levels levels;
    for (const double at : xs) {
        if (at < from || at > to) continue;
        for (const double x : {at - near, at + near}) {  // both heads of a vertical face
            const std::vector<Stratum> strata = strata_at(scene, x);
            if (strata.empty()) continue;
            levels.lowest = std::min(levels.lowest, strata.front().top);
            levels.highest = std::max(levels.highest, strata.front().top);
        }
    }
    return levels;
}

}  // namespace breach::check
