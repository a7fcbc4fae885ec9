// Small scenes for MPM tests, and bodies filled with points.
#pragma once

#include <functional>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "mpm_solver/body/fill.hpp"
#include "mpm_solver/measure/energy.hpp"
#include "mpm_solver/step.hpp"

namespace breach::mpm::test {

inline materials::Law elastic(double E, double nu) {
    return materials::LinearElastic{{.E = E, .nu = nu}};
}

inline materials::Law sand(double E, double nu, double c, double phi_deg) {
    return materials::MohrCoulomb{.elasticity = {.E = E, .nu = nu},
                                  .c = c,
                                  .phi = phi_deg * std::numbers::pi / 180.0,
                                  .psi = 0.0,
                                  .tension_cutoff = 0.0,
                                  .softening = {}};
}

inline geometry::Polygon rectangle(double x0, double y0, double x1, double y1) {
    return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

/// One soil in one polygon on a grid [0, width] x [0, height] with a frictionless floor, open ends
/// and no gravity.
inline scene::Scene one_soil(const materials::Law& law, double density,
                             const geometry::Polygon& polygon, double h, double width,
                             double height) {
    scene::Scene scene{};
    scene.name = "test";
    scene.gravity = 0.0;
    scene.thickness = 1.0;
    scene.materials = {{.name = "soil", .density = density, .law = law}};
    scene.section.regions = {{.name = "soil", .material = 0, .polygon = polygon}};
    scene::Mpm mpm{};
    mpm.cell_size = h;
    mpm.domain_x = {0.0, width};
    mpm.domain_y = {0.0, height};
    mpm.left = scene::Wall::open;
    mpm.right = scene::Wall::open;
    mpm.floor = {.level = 0.0, .friction = {{0.0, width, 0.0}}};
    mpm.gimp_half_size = 0.25;
    mpm.blending_rate = 1.0;
    mpm.anti_locking = scene::AntiLocking::on;
    mpm.gap_closure = true;
    mpm.stiffness_scale = 1.0;
    mpm.cfl = 0.4;
    mpm.duration = 1e9;
    mpm.rest = {.change = 0.05, .window = 2.0, .earliest = 3.0, .speed = 0.05};
    mpm.snapshot_interval = 1e9;
    mpm.telemetry_interval = 0.05;
    mpm.runout = {.toe = {0.0, 0.0}, .regions = {}};
    mpm.checkpoint_interval = 1e9;
    mpm.largest_energy_gain = 0.5;
    mpm.fill_points = 2;
    scene.mpm = mpm;
    return scene;
}

/// 4 x 4 m of sand at a wall, on a floor with friction: it collapses within 10 s.
inline scene::Scene sand_block() {
    scene::Scene scene =
        one_soil(sand(5e6, 0.3, 1e3, 30.0), 1800.0, rectangle(0, 0, 4, 4), 0.5, 20.0, 6.0);
    scene.gravity = 9.81;
    scene.mpm->left = scene::Wall::roller;
    scene.mpm->floor.friction = {{0.0, 20.0, 0.5}};
    scene.mpm->duration = 10.0;
    return scene;
}

/// Initial velocity at a place.
using Velocity = std::function<mechanics::Vec2(const mechanics::Vec2&)>;

/// The section filled with points; velocity gradients by central differences of the field.
inline Body filled_body(const scene::Scene& scene, const Velocity& velocity = {}) {
    exchange::ParticleState state = fill_section(scene).state;
    for (std::size_t p = 0; velocity && p < state.size(); ++p) {
        const mechanics::Vec2 x = state.position[p];
        const double d = 1e-4 * scene.mpm->cell_size;
        const mechanics::Vec2 dx{d, 0.0};
        const mechanics::Vec2 dy{0.0, d};
        state.velocity[p] = velocity(x);
        state.velocity_gradient[p].col(0) = (velocity(x + dx) - velocity(x - dx)) / (2.0 * d);
        state.velocity_gradient[p].col(1) = (velocity(x + dy) - velocity(x - dy)) / (2.0 * d);
    }
    return make_body(scene, zoned_points(scene, state, "test"), "test");
}

/// Steps at the scene's Courant number until `end` [s]; calls each(time) after every step.
inline void advance(Body& body, const scene::Scene& scene, double end,
                    const std::function<void(double)>& each = {}) {
    for (double time = 0.0; time < end * (1.0 - 1e-12);) {
        const double dt = std::min(courant_step(body, scene.mpm->cfl), end - time);
        step(body, dt);
        if (body.tally.lost != Tally::none)
            throw std::runtime_error("point " + std::to_string(body.tally.lost) + " lost at (" +
                                     std::to_string(body.points.x[body.tally.lost]) + ", " +
                                     std::to_string(body.points.y[body.tally.lost]) + ")");
        time += dt;
        if (each) each(time);
    }
}

/// numerical_loss / released; 0 if nothing was released.
inline double numerical_share(const Energy& start, const Energy& now) {
    const double available = released(start, now);
    return available > 0.0 ? numerical_loss(start, now) / available : 0.0;
}

inline mechanics::Vec2 centre_of_mass(const Points& points) {
    mechanics::Vec2 moment = mechanics::Vec2::Zero();
    double mass = 0.0;
    for (std::size_t p = 0; p < points.size(); ++p) {
        moment += points.m[p] * mechanics::Vec2{points.x[p], points.y[p]};
        mass += points.m[p];
    }
    return moment / mass;
}

inline mechanics::Vec2 momentum_of(const Points& points) {
    mechanics::Vec2 momentum = mechanics::Vec2::Zero();
    for (std::size_t p = 0; p < points.size(); ++p) {
        momentum += points.m[p] * mechanics::Vec2{points.vx[p], points.vy[p]};
    }
    return momentum;
}

inline double mechanical(const Energy& e) { return e.kinetic + e.elastic + e.gravitational; }

}  // namespace breach::mpm::test
