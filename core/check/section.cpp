#include "core/check/section.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/check/subjects.hpp"
#include "core/words/number.hpp"

namespace breach::check {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

std::string text(double value) { return words::text_of(value + 0.0); }  // no "-0"

std::string text(const Vec2& point) { return "(" + text(point.x()) + ", " + text(point.y()) + ")"; }

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

bool is_whole(const scene::Scene& scene) {
    return std::ranges::all_of(scene.section.regions, [&](const scene::Region& region) {
        return !region.polygon.empty() && region.material < scene.materials.size();
    });
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

std::string reach_of_ground(const scene::Scene& scene) {
    const geometry::Box box = extent(scene.section);
    return "the section's ground reaches from x = " + text(box.low.x()) + " to " +
           metres(box.high.x());
}

bool check_beside(const scene::Scene& scene, double from, double to, const std::string& pointer,
                  Problems& problems) {
    const geometry::Box box = extent(scene.section);
    if (to >= box.low.x() && from <= box.high.x()) return true;
    refuse(problems, pointer, "lies beside the section: x from " + text(from) + " to " + metres(to),
           reach_of_ground(scene) + ": give a range on it");
    return false;
}

}  // namespace breach::check
