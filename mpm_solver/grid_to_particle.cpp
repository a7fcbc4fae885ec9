#include <algorithm>
#include <cmath>

#include "mpm_solver/share.hpp"
#include "mpm_solver/step.hpp"

namespace breach::mpm {

namespace {

/// Nothing may go through walls, floor and terrain. Friction has done its work already.
void hold(Grid& grid, std::int32_t node) {
    Lane& v = grid.motion[node];
    const std::uint8_t must = grid.conditions[node];
    if (must & condition::floor) v[1] = std::max(v[1], 0.0);
    if (must & condition::terrain) {
        v.head<2>() = kept_out(grid.contacts[grid.contact_of[node]], {v[0], v[1]}).array();
    }
    if (must & condition::hold_x) v[0] = 0.0;
    if (must & condition::hold_y) v[1] = 0.0;
}

void move_strayed(Body& body, const Totals& sums) {
    body.tally.strayed += sums.farthest * body.grid.per_h;
    if (sums.lost != Totals::none) body.tally.lost = sums.lost;
}

}  // namespace

void grid_to_particle(Body& body, double dt) {
    if (body.order == Order::usl) forget_averages(body);
    const Totals sums = run(body, &Loops::gather, Writes::nodes, dt);
    body.tally.kinetic = sums.kinetic;
    body.tally.fastest = std::sqrt(sums.fastest_squared);
    move_strayed(body, sums);
}

void map_again(Body& body, double dt) {
    Grid& grid = body.grid;
    for (const std::int32_t node : grid.active) grid.motion[node].setZero();
    run(body, &Loops::scatter_again, Writes::nodes, dt);
    for (const std::int32_t node : grid.active) {
        if (grid.mass[node] <= 0.0) continue;
        grid.motion[node] /= grid.mass[node];
        hold(grid, node);
    }
    forget_averages(body);
    move_strayed(body, run(body, &Loops::gradient_again, Writes::nodes, dt));
}

void update_stress_first(Body& body, double dt) {
    Grid& grid = body.grid;
    // The momentum waits where the force comes later.
    for (const std::int32_t node : grid.active) {
        Lane& motion = grid.motion[node];
        motion = Lane{0.0, 0.0, motion[0], motion[1]};
        if (grid.mass[node] <= 0.0) continue;
        motion[0] = motion[2] / grid.mass[node];
        motion[1] = motion[3] / grid.mass[node];
        hold(grid, node);
    }
    forget_averages(body);
    run(body, &Loops::gradient, Writes::nodes, dt);
    update_stress(body, dt);
    for (const std::int32_t node : grid.active) {
        Lane& motion = grid.motion[node];
        motion = Lane{motion[2], motion[3], 0.0, 0.0};
    }
    run(body, &Loops::scatter_force, Writes::nodes, dt);
}

}  // namespace breach::mpm
