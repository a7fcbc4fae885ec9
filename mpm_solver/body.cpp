#include "mpm_solver/body.hpp"

#include <algorithm>
#include <string>

#include "mpm_solver/step.hpp"
#include "mpm_solver/viscosity.hpp"

namespace breach::mpm {

namespace {

void refuse_points_outside(const Grid& grid, const Points& points, const std::string& file) {
    std::size_t outside = 0;
    Vec2 first = Vec2::Zero();
    for (std::size_t p = 0; p < points.size(); ++p) {
        if (grid.holds(points.x[p], points.y[p])) continue;
        if (outside++ == 0) first = {points.x[p], points.y[p]};
    }
    if (outside == 0) return;
    throw fault::BadInput(
        file, {{"/mpm/domain_x",
                std::to_string(outside) + " of " + std::to_string(points.size()) +
                    " points lie outside the grid, the first at (" + std::to_string(first.x()) +
                    ", " + std::to_string(first.y()) + ") m",
                "enlarge /mpm/domain_x and /mpm/domain_y, or lower /mpm/floor/level"}});
}

}  // namespace

Body make_body(const scene::Scene& scene, ZonedPoints points, const std::string& file) {
    const scene::Mpm& mpm = scene::mpm_of(scene);
    Body body{.grid = make_grid(mpm),
              .points = std::move(points.points),
              .zones = std::move(points.zones),
              .gravity = {0.0, -scene.gravity},
              .gimp_half_size = mpm.gimp_half_size,
              .blending_rate = mpm.blending_rate,
              .overlap_rate = mpm.overlap_correction.rate,
              .verbs = choose_verbs(mpm),
              .averages = {},
              .drift_x = {},
              .drift_y = {},
              .tally = {}};
    refuse_points_outside(body.grid, body.points, file);
    if (mpm.anti_locking == scene::AntiLocking::on) {
        const auto cells = static_cast<std::size_t>(body.grid.nodes());
        body.averages.resize(body.zones.size());
        for (std::size_t z = 0; z < body.zones.size(); ++z) {
            body.averages[z].sums.resize(cells);
            body.averages[z].filled.reserve(
                std::min(cells, body.zones[z].end - body.zones[z].begin));
        }
    }
    if (mpm.order == scene::UpdateOrder::musl) {
        body.drift_x.resize(body.points.size());
        body.drift_y.resize(body.points.size());
    }
    for (std::size_t p = 0; p < body.points.size(); ++p) {
        const Vec2 v{body.points.vx[p], body.points.vy[p]};
        body.tally.kinetic += 0.5 * body.points.m[p] * v.squaredNorm();
        body.tally.fastest = std::max(body.tally.fastest, v.norm());
    }
    return body;
}

void refuse_buried_points(const Body& body, const std::string& file) {
    const Grid& grid = body.grid;
    const Points& points = body.points;
    if (!grid.terrain) return;
    std::size_t buried = 0;
    Vec2 first = Vec2::Zero();
    for (std::size_t p = 0; p < points.size(); ++p) {
        if (grid.terrain->distance({points.x[p], points.y[p]}) >= -1e-6 * grid.h) continue;
        if (buried++ == 0) first = {points.x[p], points.y[p]};
    }
    if (buried == 0) return;
    throw fault::BadInput(
        file, {{"/mpm/terrain",
                std::to_string(buried) + " of " + std::to_string(points.size()) +
                    " points lie below the terrain, the first at (" + std::to_string(first.x()) +
                    ", " + std::to_string(first.y()) + ") m",
                "lower the terrain there, or cut the section at it"}});
}

double wave_speed(const Body& body) {
    double fastest = 0.0;
    for (const Zone& zone : body.zones) {
        fastest = std::max(fastest, zone.elasticity.wave_speed(1.0 / zone.largest_specific_volume));
    }
    return fastest;
}

double courant_step(const Body& body, double cfl) {
    double damping = 0.0;
    for (const Zone& zone : body.zones) {
        damping = std::max(damping, viscous_speed(zone, body.grid.h));
    }
    return cfl * body.grid.h / (wave_speed(body) + body.tally.fastest + damping);
}

}  // namespace breach::mpm
