#include <algorithm>
#include <cmath>

#include "core/check/findings.hpp"
#include "core/check/section.hpp"

namespace breach::check {

namespace {

/// Soil that the terrain cuts through would begin inside it.
void check_terrain(const scene::Scene& scene, Findings& findings) {
    const scene::Mpm& mpm = *scene.mpm;
    if (mpm.terrain.empty()) return;
    const double allowed = 0.05 * mpm.cell_size;  // a drawing's inaccuracy: no point lies so deep
    for (const scene::Region& region : scene.section.regions) {
        if (region.polygon.empty()) continue;
        const Depth deepest = deepest_below(region.polygon, mpm.terrain, straight_level_at);
        if (deepest.below <= allowed) continue;
        refuse(findings, "/mpm/terrain",
               "passes through region \"" + region.name + "\", which reaches " +
                   metres(deepest.below) + " below it at " + text(deepest.place),
               "lower the terrain to " + metres(deepest.place.y()) +
                   " at x = " + metres(deepest.place.x()) + ", or cut the section at it");
    }
}

void check_toe(const scene::Scene& scene, Findings& findings) {
    const scene::Mpm& mpm = *scene.mpm;
    const Vec2& toe = mpm.runout.toe;
    const bool inside = toe.x() >= mpm.domain_x[0] && toe.x() <= mpm.domain_x[1] &&
                        toe.y() >= mpm.domain_y[0] && toe.y() <= mpm.domain_y[1];
    if (!inside)
        refuse(findings, "/mpm/runout/toe", text(toe) + " lies outside the grid",
               "give a point inside /mpm/domain_x, " + text(mpm.domain_x[0]) + " to " +
                   metres(mpm.domain_x[1]) + ", and /mpm/domain_y, " + text(mpm.domain_y[0]) +
                   " to " + metres(mpm.domain_y[1]));
}

}  // namespace

void check_ground(const scene::Scene& scene, Findings& findings) {
    check_terrain(scene, findings);
    check_toe(scene, findings);
}

}  // namespace breach::check
