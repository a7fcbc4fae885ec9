#include "mpm_solver/measure/ends.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/scene/resolution.hpp"
#include "core/words/number.hpp"
#include "core/words/remedy.hpp"
#include "mpm_solver/body/terrain.hpp"

namespace breach::mpm {

namespace {

using fault::Flag;
using fault::Severity;
using scene::Wall;
using words::text_of;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Rise of the mobile soil's depth that indicates a flow and not a settlement.
double told_rise(const FlowView& view, double first) {
    return std::max(0.1 * view.width, 0.02 * first);
}

double rise_at(const FlowView& view, const Depths& depths, std::size_t k) {
    const double rise = depths.largest[k] - depths.first[k];
    return rise > told_rise(view, depths.first[k]) ? rise : 0.0;
}

Flag pressed(const char* side, double x, double rise, const scene::Mpm& mpm) {
    const double length = mpm.domain_x[1] - mpm.domain_x[0];
    const bool right = x > mpm.domain_x[0];
    const std::array wider{mpm.domain_x[0] - (right ? 0.0 : length),
                           mpm.domain_x[1] + (right ? length : 0.0)};
    return {"reached_wall", Severity::questionable,
            "soil came against the " + std::string(side) + " wall of the grid (x = " +
                text_of(x, 9) + " m), where it stood up to " + text_of(rise) +
                " m higher than before: no real slope has such a wall, and the runout is too short "
                "(unsafe); " +
                words::set("/mpm/domain_x", wider) +
                ", and draw ground, terrain and friction zones as far",
            "/mpm/domain_x"};
}

std::vector<Flag> walls_reached(const scene::Mpm& mpm, const FlowView& view, const Depths& depths) {
    std::vector<Flag> flags;
    const std::size_t last = depths.first.size() - 1;
    const double right = rise_at(view, depths, last);
    if (mpm.right != Wall::open && right > 0.0)
        flags.push_back(pressed("right", view.high, right, mpm));
    // A pond may lean on the left wall from the start; only soil that arrives there is a fault.
    const bool free_before = depths.first.front() < told_rise(view, 0.0);
    const double left = rise_at(view, depths, 0);
    if (mpm.left != Wall::open && free_before && left > 0.0)
        flags.push_back(pressed("left", view.low, left, mpm));
    return flags;
}

/// Downstream end of the immobile soil, and its levels there.
struct GroundEnd {
    double x = -infinity;
    double top = -infinity;
    double bottom = infinity;
};

std::optional<GroundEnd> ground_end(const scene::Scene& scene) {
    GroundEnd end;
    for (const scene::Region& region : scene.section.regions) {
        if (scene::is_mobile(region, scene::mpm_of(scene))) continue;
        for (const scene::Vec2& vertex : region.polygon) {
            if (vertex.x() < end.x) continue;
            if (vertex.x() > end.x) end = {.x = vertex.x()};
            end.top = std::max(end.top, vertex.y());
            end.bottom = std::min(end.bottom, vertex.y());
        }
    }
    if (end.x == -infinity) return std::nullopt;
    return end;
}

/// Flags soil that flowed over a step at the end of the ground.
std::optional<Flag> ground_left(const scene::Scene& scene, const FlowView& view,
                                const Depths& depths) {
    const scene::Mpm& mpm = scene::mpm_of(scene);
    const auto end = ground_end(scene);
    // Ground that reaches the end of the grid leaves no step for soil to fall over.
    if (!end || end->x + view.width > view.high) return std::nullopt;
    const double beyond =
        mpm.terrain.empty() ? mpm.floor.level : Terrain(mpm.terrain).level(end->x + view.width);
    const double step = end->top - beyond;
    if (step < 0.5 * view.width) return std::nullopt;
    const std::vector<double> places = profile_places(view);
    double deepest = 0.0;
    for (std::size_t k = 0; k < places.size(); ++k)
        if (places[k] >= end->x + view.width) deepest = std::max(deepest, rise_at(view, depths, k));
    if (deepest == 0.0) return std::nullopt;
    return Flag{"reached_wall", Severity::questionable,
                "soil flowed over the end of the section's ground (x = " + text_of(end->x, 9) +
                    " m), where the model drops by " + text_of(step) +
                    " m and nature does not: the runout is wrong; draw the ground on to the end of "
                    "domain_x, x = " +
                    text_of(view.high, 9) +
                    " m, or let the terrain rise to its top behind it: \"terrain\": [..., [" +
                    text_of(end->x, 9) + ", " + text_of(end->bottom, 9) + "], [" +
                    text_of(end->x + 0.1 * view.width, 9) + ", " + text_of(end->top, 9) + "], [" +
                    text_of(view.high, 9) + ", " + text_of(end->top, 9) + "]]",
                "/section/regions"};
}

/// The crest's edge: farthest downstream place where the mobile soil was about as high as anywhere.
double crest_edge(const std::vector<double>& places, const std::vector<double>& depth) {
    const double highest = *std::ranges::max_element(depth);
    std::size_t k = depth.size() - 1;
    while (k > 0 && depth[k] < 0.95 * highest) --k;
    return places[k];
}

/// Flags a lower surface at the upstream end, where soil has left.
std::optional<Flag> upstream_end_reached(const scene::Scene& scene, const FlowView& view,
                                         const Depths& depths) {
    const double H = scene::mobile_height(scene, scene::mpm_of(scene));
    const std::vector<double> places = profile_places(view);
    std::size_t k = 0;
    while (k < places.size() && depths.first[k] < told_rise(view, 0.0)) ++k;
    // Column 1 still counts as the end: soil may begin within the first cell.
    if (k > 1) return std::nullopt;  // a free face, or no mobile soil
    const double end = places[k];
    const double told = std::max(0.05 * H, 0.5 * view.width);
    while (k < places.size() && depths.first[k] - depths.last[k] <= told) ++k;
    if (k == places.size() || places[k] - end > H) return std::nullopt;
    const double pond = crest_edge(places, depths.first) - end;
    const std::string fact = "the failure reached x = " + text_of(places[k], 9) + " m, " +
                             text_of(places[k] - end) +
                             " m from the upstream end (x = " + text_of(end, 9) +
                             " m; the mobile soil is " + text_of(H) + " m high)";
    if (pond < H)
        return Flag{
            "upstream_wall", Severity::warning,
            fact +
                ", behind a crest narrower than that. This is right at a wall or a plane of "
                "symmetry. If soil continues upstream, draw it; otherwise the runout is too short",
            "/section/regions"};
    if (pond >= scene::enough_heights_upstream * H)
        return Flag{"upstream_wall", Severity::warning,
                    fact + "; the soil goes on " + text_of(pond / H, 2) +
                        " heights upstream of the crest; " + scene::why_enough_upstream(),
                    "/section/regions"};
    return Flag{"upstream_wall", Severity::questionable,
                fact +
                    ": the section ends too near, so that soil is missing and the runout is too "
                    "short (unsafe); draw the section and begin domain_x " +
                    text_of(std::ceil(scene::enough_heights_upstream * H - pond)) +
                    " m farther upstream: " + scene::why_enough_upstream(),
                "/section/regions"};
}

}  // namespace

std::vector<Flag> flags_of_ends(const scene::Scene& scene, const FlowView& view,
                                const Depths& depths) {
    std::vector<Flag> flags = walls_reached(scene::mpm_of(scene), view, depths);
    if (auto flag = ground_left(scene, view, depths)) flags.push_back(std::move(*flag));
    if (auto flag = upstream_end_reached(scene, view, depths)) flags.push_back(std::move(*flag));
    return flags;
}

}  // namespace breach::mpm
