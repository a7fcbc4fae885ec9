#include "fem_solver/monitors/upstream_wall.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/scene/resolution.hpp"
#include "core/words/number.hpp"
#include "fem_solver/model/stages.hpp"

namespace breach::fem {
namespace {

constexpr double fails = 0.05;   // displacement over the section's height
constexpr double moves = 0.1;    // of the largest displacement
constexpr double near = 1.0;     // section heights from the end
constexpr double sloping = 0.1;  // over the height, from side to side

/// The section's upstream end, where the ground is higher.
struct UpstreamEnd {
    double x, height;  ///< [m]
    double side;       ///< 1: downstream is +x; 0: level ground
    double relief;     ///< from one side's ground to the other's [m]
    double distance(const Vec2& at) const { return side * (at.x() - x); }
};

UpstreamEnd upstream_end(const Model& model, const std::vector<bool>& lonely) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Vec2 low(infinity, infinity), high(-infinity, -infinity);
    for (std::size_t i = 0; i < model.body.nodes; ++i) {
        if (lonely[i]) continue;
        low = low.cwiseMin(model.mesh.nodes[i]);
        high = high.cwiseMax(model.mesh.nodes[i]);
    }
    double left = low.y(), right = low.y();
    const double at_side = 1e-6 * (high - low).norm();
    for (std::size_t i = 0; i < model.body.nodes; ++i) {
        const Vec2& x = model.mesh.nodes[i];
        if (lonely[i]) continue;
        if (x.x() - low.x() <= at_side) left = std::max(left, x.y());
        if (high.x() - x.x() <= at_side) right = std::max(right, x.y());
    }
    const double height = high.y() - low.y();
    const double relief = std::abs(left - right);
    // Level ground from side to side: neither end is upstream.
    if (relief <= sloping * height) return {low.x(), height, 0.0, relief};
    return left > right ? UpstreamEnd{low.x(), height, 1.0, relief}
                        : UpstreamEnd{high.x(), height, -1.0, relief};
}

/// The part of the failing mass nearest to the end.
struct Nearest {
    double distance = std::numeric_limits<double>::infinity();
    std::string what;
    Vec2 where = Vec2::Zero();

    void look(const UpstreamEnd& end, const Vec2& at, const char* kind) {
        if (end.distance(at) >= distance) return;
        distance = end.distance(at);
        what = kind;
        where = at;
    }
};

/// Displacements relative to the base [m].
std::vector<double> displacements(const Model& model, const Motion& motion,
                                  const std::vector<bool>& lonely) {
    const auto lowest = std::ranges::min_element(
        model.mesh.nodes.begin(),
        model.mesh.nodes.begin() + static_cast<std::ptrdiff_t>(model.body.nodes), {},
        [](const Vec2& x) { return x.y(); });
    // An earthquake moves everything: only what moves against the base has failed.
    const auto base = 2 * (lowest - model.mesh.nodes.begin());
    std::vector<double> moved;
    for (std::size_t i = 0; i < model.body.nodes; ++i) {
        const auto d = static_cast<Eigen::Index>(2 * i);
        const Vec2 u = motion.u.segment<2>(d) - motion.u.segment<2>(base);
        moved.push_back(lonely[i] ? 0.0 : u.norm());
    }
    return moved;
}

Nearest nearest_failing(const scene::Fem& fem, const Model& model, const Motion& motion,
                        const Beginning& beginning, std::span<const double> excess_max,
                        const UpstreamEnd& end, std::span<const double> moved) {
    Nearest nearest;
    const double largest = std::ranges::max(moved);
    for (std::size_t i = 0; i < moved.size(); ++i)
        // Three signs of failure; the one that comes nearest to the end is reported.
        if (moved[i] > moves * largest) nearest.look(end, model.mesh.nodes[i], "soil that moves");
    for (std::size_t e = 0; e < model.body.elements; ++e) {
        if (model.is_absent(e) || element_epsilon_q(model, motion, e) <= fem.failure_strain)
            continue;
        nearest.look(end, corners_of(model.mesh, e).rowwise().mean(), "soil that has sheared");
    }
    if (!fem.liquefaction || excess_max.empty()) return nearest;
    const auto r_u =
        pore_pressure_ratio(excess_max, beginning.sigma_v0, fem.liquefaction->least_stress);
    for (std::size_t i = 0; i < r_u.size(); ++i)
        if (r_u[i] > fem.liquefaction->r_u)
            nearest.look(end, model.mesh.nodes[i], "soil that has liquefied");
    return nearest;
}

}  // namespace

std::optional<fault::Flag> upstream_wall(const scene::Fem& fem, const Model& model,
                                         const Motion& motion, const Beginning& beginning,
                                         bool surface_cuts_through, std::size_t crest_node,
                                         std::span<const double> excess_max) {
    const std::vector<bool> lonely = lonely_nodes(model);
    const UpstreamEnd end = upstream_end(model, lonely);
    const std::vector<double> moved = displacements(model, motion, lonely);
    if (end.side == 0.0 || (!surface_cuts_through && std::ranges::max(moved) < fails * end.height))
        return std::nullopt;
    const Nearest nearest = nearest_failing(fem, model, motion, beginning, excess_max, end, moved);
    const double allowed = near * end.height;
    if (!(nearest.distance < allowed)) return std::nullopt;
    const auto metres = [](double value) { return words::text_of(value, 4) + " m"; };
    const std::string fact = "The failing mass comes to within " + metres(nearest.distance) +
                             " of the section's upstream end at x = " + metres(end.x) + " (" +
                             nearest.what + " at x = " + metres(nearest.where.x()) +
                             ", y = " + metres(nearest.where.y()) +
                             "), nearer than the section is high (" + metres(end.height) + ")";
    const double heights = end.distance(model.mesh.nodes[crest_node]) / end.relief;
    if (heights >= scene::enough_heights_upstream)
        return fault::Flag{"upstream_wall", fault::Severity::warning,
                           fact + ". The soil goes on " + words::text_of(heights, 2) +
                               " heights upstream of the crest; " + scene::why_enough_upstream(),
                           "/section/regions"};
    return fault::Flag{
        "upstream_wall", fault::Severity::questionable,
        fact +
            ". The boundary there takes part in the failure and cuts its volume off. Draw the "
            "section at least " +
            metres(allowed - nearest.distance) +
            " longer upstream, to x = " + metres(end.x - end.side * (allowed - nearest.distance)),
        "/section/regions"};
}

}  // namespace breach::fem
