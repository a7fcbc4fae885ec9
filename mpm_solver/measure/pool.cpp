// Reports at the end of a runout what still water cannot do. It neither flows nor falls: a pool
// stays full when its dam has gone, and a scarp that sinks below the pool feels the pressure of the
// dam's pores, as the line of /mpm/water falls through the dam. Called once by results.cpp with the
// last state. The water may stand at either end of the grid, or at both.
#include "mpm_solver/measure/pool.hpp"

#include <algorithm>

#include "core/geometry/polyline.hpp"
#include "core/words/number.hpp"

namespace breach::mpm {

namespace {

using fault::Flag;
using fault::Severity;
using words::text_of;

constexpr const char* pointer = "/mpm/water/line";

/// Columns from one end of the grid to the first that rises to the pool; empty: the water does not
/// stand at that end.
struct Shore {
    std::vector<std::size_t> wet;
    bool is_held = true;  ///< some column rises to the pool
};

Shore shore_from(bool left, const scene::Pool& pool, double level, const FlowView& view,
                 const std::vector<double>& top) {
    Shore shore;
    // Where the line ends lower, the water has run through the dam and is no pool.
    const double here = geometry::level_at(pool.line, left ? view.low : view.high);
    if (here < level - 1e-6 * std::max(1.0, std::abs(level))) return shore;
    shore.is_held = false;
    for (std::size_t k = 0; k < top.size() && !shore.is_held; ++k) {
        const std::size_t column = left ? k : top.size() - 1 - k;
        shore.is_held = top[column] >= level;
        if (!shore.is_held) shore.wet.push_back(column);
    }
    return shore;
}

}  // namespace

Surfaces surfaces_of(const scene::Scene& scene, const Body& body, const FlowView& view) {
    const std::vector<double> places = profile_places(view);
    std::vector<double> bottom(places.size(), scene::mpm_of(scene).floor.level);
    for (std::size_t k = 0; body.grid.terrain && k < places.size(); ++k)
        bottom[k] = body.grid.terrain->level(places[k]);
    Surfaces surfaces{.ground = ground_profile(body.points, view, std::move(bottom)), .top = {}};
    surfaces.top = surface_profile(body.points, view, surfaces.ground);
    return surfaces;
}

std::vector<Flag> flags_of_pool(const scene::Scene& scene, const Body& body, const FlowView& view,
                                const Surfaces& surfaces) {
    if (!scene::mpm_of(scene).water) return {};
    const scene::Pool& pool = *scene::mpm_of(scene).water;
    const std::vector<double> places = profile_places(view);
    // The highest point of the line within the grid: a line may rise to the pool beyond its first
    // vertex.
    const double level = scene::highest_level(pool, view.low, view.high);
    std::vector<Flag> flags{
        {"standing_water", Severity::warning,
         "the water stands still: its pressure acts, its drag on moving soil (rho v^2 / 2) and the "
         "mass that it adds do not; soil that runs into it would be slower: the runout is an upper "
         "bound",
         "/mpm/water"}};
    bool held = true;
    double missing = 0.0, from = view.high, to = view.low;
    for (const bool left : {true, false}) {
        const Shore shore = shore_from(left, pool, level, view, surfaces.top);
        held = held && shore.is_held;
        for (const std::size_t k : shore.wet) {
            const double due = pool.density * scene.gravity * (level - surfaces.top[k]);
            const double lack = due - body.water.pressure({places[k], surfaces.top[k]});
            // Less than a tenth, or than the pressure of one column's width of water, is within
            // what columns resolve.
            if (lack <= 0.1 * due || lack <= pool.density * scene.gravity * view.width) continue;
            missing = std::max(missing, lack);
            from = std::min(from, places[k]), to = std::max(to, places[k]);
        }
    }
    if (!held) {
        flags.push_back({"pool_runs_over", Severity::questionable,
                         "no soil is left above the water at " + text_of(level, 9) +
                             " m: it would run over and carry soil away, which is out of scope; "
                             "take the water's volume to a program of floods",
                         pointer});
    } else if (missing > 0.0) {
        flags.push_back({"scarp_without_pool", Severity::warning,
                         "from x = " + text_of(from, 9) + " to " + text_of(to, 9) +
                             " m the surface sank below the pool where the line falls: up to " +
                             text_of(1e-3 * missing) +
                             " kPa of the pool's pressure on the scarp are missing, and it fails "
                             "more easily than it would; compare with the line drawn level up to "
                             "the scarp",
                         pointer});
    }
    return flags;
}

}  // namespace breach::mpm
