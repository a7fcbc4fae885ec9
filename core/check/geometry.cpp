#include <algorithm>
#include <cmath>
#include <optional>

#include "core/check/section.hpp"
#include "core/check/subjects.hpp"

namespace breach::check {

namespace {

constexpr double nearly_parallel = 0.94;  // cosine of 20 degrees
constexpr double slit = 0.25;             // largest width over length; wider gaps are valleys
constexpr double short_side = 0.05;       // of an element

/// Widths of unintended gaps between regions: smaller ones do not exist for the meshers, larger
/// ones are valleys.
struct GapRange {
    double least, largest;
};

GapRange gap_range(const scene::Scene& scene, const scene::Region& a, const scene::Region& b) {
    const geometry::Box box = extent(scene.section);
    const double height = box.high.y() - box.low.y();
    GapRange range{1e-3 * height, 0.02 * height};
    if (scene.mpm) {
        range.least = std::min(range.least, 1e-3 * scene.mpm->cell_size);
        range.largest = std::max(range.largest, scene.mpm->cell_size);
    }
    if (!scene.fem || scene.fem->mesh.msh_file) return range;
    const bool unstructured = std::ranges::any_of(scene.section.regions, [](const auto& each) {
        return each.mesh == scene::RegionMesh::unstructured;
    });
    // The distance within which the meshers merge two points.
    range.least = std::min(range.least, unstructured ? 1e-9 * (box.high - box.low).norm()
                                                     : 1e-6 * least_element_size(scene));
    range.largest = std::max({range.largest, element_size(a), element_size(b)});
    return range;
}

struct Gap {
    double width;
    Vec2 from, to;  ///< widest place: on one region, and its foot on the other
};

/// The gap between two nearly parallel sides that face each other.
std::optional<Gap> gap_between(const scene::Scene& scene, const Side& one, const Side& other) {
    const Vec2 along = (one.b - one.a).normalized();
    const Vec2 back = (other.a - other.b).normalized();
    if (along.dot(back) < nearly_parallel) return std::nullopt;
    const Vec2 outwards(along.y(), -along.x());
    const double length = (one.b - one.a).norm();
    const double s_a = along.dot(other.b - one.a), s_b = along.dot(other.a - one.a);
    const double begin = std::max(0.0, s_a), end = std::min(length, s_b);
    if (end <= begin) return std::nullopt;
    const auto across = [&](double s) {
        return other.b + (other.a - other.b) * ((s - s_a) / (s_b - s_a));
    };
    const auto width = [&](double s) { return outwards.dot(across(s) - one.a); };
    const double w_begin = width(begin), w_end = width(end);
    const double widest = std::max(w_begin, w_end);
    if (std::min(w_begin, w_end) < -1e-3 * widest || widest > slit * (end - begin))
        return std::nullopt;
    for (const double share : {0.25, 0.5, 0.75}) {
        const double s = begin + share * (end - begin);
        const Vec2 middle = 0.5 * (one.a + s * along + across(s));
        if (in_soil(scene.section, middle)) continue;
        const double at = w_begin > w_end ? begin : end;
        return Gap{widest, one.a + at * along, across(at)};
    }
    return std::nullopt;
}

void check_pair(const scene::Scene& scene, std::size_t i, std::size_t j, Problems& problems) {
    const scene::Region& a = scene.section.regions[i];
    const scene::Region& b = scene.section.regions[j];
    const GapRange range = gap_range(scene, a, b);
    const geometry::Box A = geometry::bounding_box(a.polygon),
                        B = geometry::bounding_box(b.polygon);
    if (((A.low - B.high).array() > range.largest).any() ||
        ((B.low - A.high).array() > range.largest).any())
        return;
    std::optional<Gap> widest;
    for (const Side& one : sides_of(a.polygon)) {
        for (const Side& other : sides_of(b.polygon)) {
            const auto gap = gap_between(scene, one, other);
            if (!gap || gap->width <= range.least || gap->width > range.largest) continue;
            if (!widest || gap->width > widest->width) widest = gap;
        }
    }
    if (!widest) return;
    refuse(problems, region_pointer(j, "/polygon"),
           "leaves a gap of " + metres(widest->width) + " to region \"" + a.name + "\" at " +
               text(widest->to),
           "regions that touch share their border: let \"" + b.name + "\" pass through " +
               text(widest->from) + ", or make it a valley wider than " + metres(range.largest));
}

void check_slivers(const scene::Region& region, std::size_t index, Problems& problems) {
    const double size = element_size(region);
    for (const Side& side : sides_of(region.polygon)) {
        const double length = (side.b - side.a).norm();
        if (length >= short_side * size) continue;
        warn(problems, "sliver", region_pointer(index, "/polygon"),
             "\"" + region.name + "\" has a side of " + metres(length) + " at " + text(side.a) +
                 " among elements of " + metres(size) +
                 ": elements there are slivers; leave out one of its vertices");
        return;
    }
}

}  // namespace

void check_geometry(const scene::Scene& scene, Problems& problems) {
    const auto& regions = scene.section.regions;
    for (std::size_t i = 0; i < regions.size(); ++i) {
        if (regions[i].polygon.empty()) continue;
        for (std::size_t j = i + 1; j < regions.size(); ++j)
            if (!regions[j].polygon.empty()) check_pair(scene, i, j, problems);
        if (scene.fem && !scene.fem->mesh.msh_file) check_slivers(regions[i], i, problems);
    }
}

}  // namespace breach::check
