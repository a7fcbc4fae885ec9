#include "core/check/segment.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace breach::check {

namespace {

bool crosses(const Side& one, const Side& other) {
    const auto turn = [](const Vec2& a, const Vec2& b, const Vec2& c) {
        return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
    };
    return turn(one.a, one.b, other.a) * turn(one.a, one.b, other.b) < 0.0 &&
           turn(other.a, other.b, one.a) * turn(other.a, other.b, one.b) < 0.0;
}

/// Least distance between the segment and the region's border; 0 where they cross.
double distance_to_border(const scene::Region& region, const Side& segment) {
    double least = std::numeric_limits<double>::infinity();
    for (const Side& side : sides_of(region.polygon)) {
        if (crosses(side, segment)) return 0.0;
        least = std::min({least, geometry::distance_to_segment(side.a, segment.a, segment.b),
                          geometry::distance_to_segment(segment.a, side.a, side.b),
                          geometry::distance_to_segment(segment.b, side.a, side.b)});
    }
    return least;
}

double shared_length(const Side& side, const Side& segment, double tolerance) {
    const double length = (side.b - side.a).norm();
    const Vec2 along = (side.b - side.a) / length;
    const Vec2 across(-along.y(), along.x());
    if (std::abs(across.dot(segment.a - side.a)) > tolerance ||
        std::abs(across.dot(segment.b - side.a)) > tolerance)
        return 0.0;
    const auto [begin, end] =
        std::minmax({along.dot(segment.a - side.a), along.dot(segment.b - side.a)});
    return std::min(length, end) - std::max(0.0, begin);
}

}  // namespace

bool touches(const scene::Region& region, const Side& segment, double tolerance) {
    for (const Side& side : sides_of(region.polygon)) {
        if (geometry::distance_to_segment(side.a, segment.a, segment.b) <= tolerance) return true;
        if (shared_length(side, segment, tolerance) > tolerance) return true;
    }
    return region.mesh == scene::RegionMesh::block &&
           (distance_to_border(region, segment) <= tolerance ||
            geometry::contains(region.polygon, segment.a, tolerance));
}

bool may_hold_nodes(const scene::Scene& scene, const Side& segment, double tolerance) {
    return std::ranges::any_of(scene.section.regions, [&](const scene::Region& region) {
        return !region.polygon.empty() && touches(region, segment, tolerance);
    });
}

double length_on_sides(const scene::Scene& scene, const Side& segment, double tolerance) {
    double sum = 0.0;
    for (const scene::Region& region : scene.section.regions)
        for (const Side& side : sides_of(region.polygon))
            sum += std::max(0.0, shared_length(side, segment, tolerance));
    return sum;
}

std::string how_it_misses(const scene::Scene& scene, const Side& segment) {
    double least = std::numeric_limits<double>::infinity();
    for (const scene::Region& region : scene.section.regions)
        if (!region.polygon.empty()) least = std::min(least, distance_to_border(region, segment));
    if (in_soil(scene.section, segment.a) || least == 0.0)
        return "crosses the soil, where it cannot be matched to nodes";
    return "touches no node: it runs " + metres(least) + " away from the section";
}

}  // namespace breach::check
