#include "mpm_solver/body/body.hpp"

#include <algorithm>
#include <string>

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

/// As if nothing had yielded; points of a checkpoint have their own.
void start_viscosity(Body& body) {
    const auto resists = [](const Zone& zone) { return zone.viscosity + zone.damping > 0.0; };
    std::vector<double>& eta = body.points.eta;
    if (!eta.empty() || std::ranges::none_of(body.zones, resists)) return;
    eta.resize(body.points.size());
    for (const Zone& zone : body.zones)
        std::fill(eta.begin() + static_cast<std::ptrdiff_t>(zone.begin),
                  eta.begin() + static_cast<std::ptrdiff_t>(zone.end),
                  zone.viscosity + zone.damping);
}

/// With fewer points per thread, sharing costs more than it saves.
constexpr std::size_t least_points_per_thread = 2000;

int useful_threads(int asked_for, std::size_t points) {
    return std::min(asked_for, 1 + static_cast<int>(points / least_points_per_thread));
}

}  // namespace

Body make_body(const scene::Scene& scene, ZonedPoints points, const std::string& file,
               const Computing& computing, const mechanics::NodalField& steady) {
    const scene::Mpm& mpm = scene::mpm_of(scene);
    Body body{.grid = make_grid(mpm),
              .points = std::move(points.points),
              .zones = std::move(points.zones),
              .gravity = {0.0, -scene.gravity},
              .gimp_half_size = mpm.gimp_half_size,
              .blending_rate = mpm.blending_rate,
              .overlap_rate = mpm.overlap_correction.rate,
              .widest = 4.0 * mpm.cell_size * mpm.cell_size * scene.thickness,
              .averages = {},
              .loops = {},
              .softening = {},
              .water = scene::StandingWater(scene, steady),
              .strips = {},
              .team = {},
              .sums = {},
              .tally = {}};
    refuse_points_outside(body.grid, body.points, file);
    body.averages.resize(body.zones.size());
    for (std::size_t z = 0; z < body.zones.size(); ++z) {
        const Zone& zone = body.zones[z];
        const Choice choice = choice_of(mpm, {zone.material, zone.law, zone.viscosity});
        body.loops.push_back(choose_loops(choice, computing.instructions));
        if (choice.averages == Averages::per_cell) body.averages[z].resize(body.grid.nodes());
    }
    body.softening =
        NonlocalSoftening(body.points, body.zones, body.grid, body.gimp_half_size, body.widest);
    // A checkpoint brings the strains of its last average; a fresh run counts increments from here.
    if (body.softening.is_on() && body.points.epsilon_q_shared.empty())
        NonlocalSoftening::remember(body.points);
    const std::size_t n = body.points.size();
    start_viscosity(body);
    if (body.overlap_rate > 0.0) body.points.excess.resize(n);
    body.points.cell.resize(n);
    body.team = std::make_shared<numerics::Team>(useful_threads(computing.threads, n));
    for (std::size_t p = 0; p < n; ++p) {
        const Vec2 v{body.points.vx[p], body.points.vy[p]};
        body.tally.kinetic += 0.5 * body.points.m[p] * v.squaredNorm();
        body.tally.fastest = std::max(body.tally.fastest, v.norm());
    }
    // Points::resize sets homes to -1. Sorting a checkpoint's points anew would add the sums of
    // nodes in another order, and a resumed run would not have the same bits.
    const bool has_homes = body.points.home[0] >= 0;
    if (has_homes) {
        body.strips.cut(body.grid, body.points, body.zones);
    } else {
        body.strips.sort(body.grid, body.points, body.zones);
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
        // The density of the force (V) and not of the tracked volume: soil that sprays swells, and
        // would shorten the step of all others although its gaps carry no stress.
        fastest = std::max(fastest, zone.elasticity.wave_speed(1.0 / zone.largest_specific_volume));
    }
    return fastest;
}

double viscous_speed(const Zone& zone, double eta, double h) {
    return 16.0 / 3.0 * eta * zone.largest_specific_volume / h;
}

double courant_step(const Body& body, double cfl) {
    // Two limits. The scene's Courant number holds for waves, flow and the material's viscosity.
    // Damping counts only against the stability limit, so that soil at rest does not shorten the
    // step.
    double viscous = 0.0;
    double damped = 0.0;
    for (const Zone& zone : body.zones) {
        viscous = std::max(viscous, viscous_speed(zone, zone.viscosity, body.grid.h));
        damped = std::max(damped, viscous_speed(zone, zone.viscosity + zone.damping, body.grid.h));
    }
    const double speed = wave_speed(body) + body.tally.fastest;
    return body.grid.h * std::min(cfl / (speed + viscous), largest_courant / (speed + damped));
}

}  // namespace breach::mpm
