// The step reads like docs/reference/methods/mpm.md, *One step*; the work per point is in loops/.
// Nodes are updated on one thread, which takes a few per cent of a step.
#include "mpm_solver/step.hpp"

#include <algorithm>
#include <cmath>

#include "mpm_solver/share.hpp"

namespace breach::mpm {

namespace {

/// Coulomb friction of a node pressed on the floor: its impulse is at most mu times the normal one.
/// Returns the work of friction, impulse x (v_before + v_after) / 2 [J], exact for the node's
/// kinetic energy.
double rub(double m, double mu, const Vec2& v_before, Vec2& v) {
    if (v.y() >= 0.0) return 0.0;  // lifts off
    const double normal = -m * v.y();
    v.y() = 0.0;
    const double free_vx = v.x();
    const double most = mu * normal / m;
    v.x() = std::copysign(std::max(std::abs(free_vx) - most, 0.0), free_vx);
    return m * (free_vx - v.x()) * 0.5 * (v_before.x() + v.x());
}

/// Applies walls, floor and terrain to a node's velocity; returns the work of friction. Walls come
/// first: what they hold does not slide. Between wall and slope a node cannot move down.
double bear(const Grid& grid, std::int32_t node, const Vec2& v_before, Vec2& v) {
    const std::uint8_t must = grid.conditions[node];
    if (must & condition::hold_x) v.x() = 0.0;
    if (must & condition::hold_y) v.y() = 0.0;
    const double m = grid.mass[node];
    double work = 0.0;
    if (must & condition::floor) work += rub(m, grid.friction[node / grid.rows], v_before, v);
    if (must & condition::terrain) {
        if (must & condition::hold_x) {
            v.y() = std::max(v.y(), 0.0);
        } else {
            work += rub(grid.contacts[grid.contact_of[node]], m, v_before, v);
        }
    }
    if (must & condition::hold_y) v.y() = 0.0;
    return work;
}

void move_strayed(Body& body, const Totals& sums) {
    body.tally.strayed += sums.farthest * body.grid.per_h;
    if (sums.lost != Totals::none) body.tally.lost = sums.lost;
}

/// Totals of one kind in the cells become averages over their volume.
void average(Body& body, double CellSum::*number) {
    for (std::size_t z = 0; z < body.averages.size(); ++z) {
        std::vector<CellSum>& sums = body.averages[z];
        if (sums.empty()) continue;
        for (const std::int32_t cell : body.strips.cells(z)) {
            if (sums[cell].V > 0.0) sums[cell].*number /= sums[cell].V;
        }
    }
}

/// Work of the moving frame's inertial force, impulse x (v_before + v_after) / 2 [J].
double work_of_frame(const Body& body, double dt) {
    const Grid& grid = body.grid;
    double momentum = 0.0;
    for (const std::int32_t node : grid.active) {
        // Velocity after the step minus half its change: the mean of before and after.
        momentum += grid.mass[node] * (grid.motion[node][0] - 0.5 * grid.motion[node][2]);
    }
    return -body.frame_acceleration * dt * momentum;
}

/// body.sums are still those of settle, the last loop of the step.
void find_lightest(Body& body) {
    for (std::size_t z = 0; z < body.zones.size(); ++z) {
        double largest = 0.0;
        for (const std::size_t strip : body.strips.all()) {
            largest =
                std::max(largest, body.sums[strip * body.zones.size() + z].largest_specific_volume);
        }
        body.zones[z].largest_specific_volume = largest;
    }
}

}  // namespace

void keep_sorted(Body& body) {
    if (body.tally.strayed <= Strips::largest_stray) return;
    body.strips.sort(body.grid, body.points, body.zones);
    body.tally.strayed = 0.0;
}

void step(Body& body, double dt) {
    keep_sorted(body);
    clear(body.grid);
    particle_to_grid(body, dt);
    update_momentum(body, dt);
    if (body.frame_acceleration != 0.0) body.tally.shaking += work_of_frame(body, dt);
    grid_to_particle(body, dt);
    update_stress(body, dt);
}

void particle_to_grid(Body& body, double dt) {
    // The stress is that of the end of the last step, and with it the volume V.
    for_all_points(body, &Loops::scatter, Writes::nodes, dt);
}

void update_momentum(Body& body, double dt) {
    Grid& grid = body.grid;
    const Vec2 pull = body.gravity - Vec2{body.frame_acceleration, 0.0};
    double friction_work = 0.0;
    for (const std::int32_t node : grid.active) {
        const double m = grid.mass[node];
        // Active, as a point could have come here, but none did.
        if (m <= 0.0) {
            grid.motion[node].setZero();
            continue;
        }
        const Lane motion = grid.motion[node] / m;
        const Vec2 v_before{motion[0], motion[1]};
        Vec2 v = v_before + dt * (Vec2{motion[2], motion[3]} + pull);
        if (grid.conditions[node] != 0) friction_work += bear(grid, node, v_before, v);
        grid.motion[node] << v.x(), v.y(), v.x() - v_before.x(), v.y() - v_before.y();
    }
    body.tally.friction += friction_work;
}

void grid_to_particle(Body& body, double dt) {
    // The cells are filled anew: volume and rate by gather, mean stress by stress(). Both weigh
    // with the same V, which only settle changes.
    forget_averages(body);
    const Totals sums = for_all_points(body, &Loops::gather, Writes::nodes, dt);
    body.tally.kinetic = sums.kinetic;
    body.tally.fastest = std::sqrt(sums.fastest_squared);
    move_strayed(body, sums);
}

void update_stress(Body& body, double dt) {
    average(body, &CellSum::trD);
    body.tally.viscous += for_all_points(body, &Loops::dissipate, Writes::own_points, dt).viscous;
    const Totals sums = for_all_points(body, &Loops::stress, Writes::nodes, dt);
    if (body.softening.is_on()) body.softening.follow(body.points, body.zones, body.grid);
    body.tally.plastic += sums.plastic;
    body.tally.pushed_in += sums.pushed_in;
    average(body, &CellSum::sigma_m);
    // Reads cells, therefore after all strips have added to them.
    for_all_points(body, &Loops::settle, Writes::own_points, dt);
    find_lightest(body);
}

}  // namespace breach::mpm
