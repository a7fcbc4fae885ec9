#include "mpm_solver/body/grid.hpp"

#include <cmath>

namespace breach::mpm {

namespace {

/// Friction of the floor at x; at a border that of the zone on the right.
double friction_at(const std::vector<scene::FrictionZone>& zones, double x, double tolerance) {
    double coefficient = 0.0;
    for (const scene::FrictionZone& zone : zones) {
        if (x >= zone.from - tolerance && x <= zone.to + tolerance) coefficient = zone.coefficient;
    }
    return coefficient;
}

/// Nodes within half a cell of the terrain, and all below it, are in contact
/// (docs/reference/methods/mpm.md, *Contact*).
void lay_terrain(Grid& grid, const scene::Mpm& mpm) {
    grid.terrain.emplace(mpm.terrain);
    grid.contact_of.assign(grid.conditions.size(), 0);
    for (std::int32_t i = 0; i < grid.columns; ++i) {
        const double x = grid.origin.x() + i * grid.h;
        // A floor without zones holds soil, and then so does the terrain.
        const double friction =
            mpm.floor.friction.empty() ? std::numeric_limits<double>::infinity() : grid.friction[i];
        for (std::int32_t j = 0; j < grid.rows; ++j) {
            const Vec2 node{x, grid.origin.y() + j * grid.h};
            const auto contact = grid.terrain->contact(node, 0.5 * grid.h, friction);
            if (!contact) continue;
            grid.conditions[i * grid.rows + j] |= condition::terrain;
            grid.contact_of[i * grid.rows + j] = static_cast<std::int32_t>(grid.contacts.size());
            grid.contacts.push_back(*contact);
        }
    }
}

std::uint8_t wall_condition(scene::Wall wall) {
    switch (wall) {
        case scene::Wall::roller:
            return condition::hold_x;
        case scene::Wall::fixed:
            return condition::hold_x | condition::hold_y;
        case scene::Wall::open:
            break;
    }
    return 0;
}

}  // namespace

Grid make_grid(const scene::Mpm& mpm) {
    const double h = mpm.cell_size;
    const auto cells = [h](double from, double to) {
        return static_cast<std::int32_t>(std::lround((to - from) / h));
    };
    const std::int32_t cells_x = cells(mpm.domain_x[0], mpm.domain_x[1]);
    const std::int32_t cells_y = cells(mpm.floor.level, mpm.domain_y[1]);

    Grid grid{};
    grid.h = h;
    grid.per_h = 1.0 / h;
    grid.origin = {mpm.domain_x[0] - h, mpm.floor.level - h};
    // One node more than cells, and a ghost node at each end: the 3 x 3 nodes of a point on a wall
    // are all in the arrays.
    grid.columns = cells_x + 3;
    grid.rows = cells_y + 3;
    const double round_off = 1e-9 * h;  // a point on a wall is inside up to round-off
    grid.low = {mpm.domain_x[0] - round_off, mpm.floor.level - round_off};
    grid.high = {mpm.domain_x[1] + round_off, mpm.domain_y[1] + round_off};
    // An open end clips no domain; a point that reaches it is lost, which ends the run (guard.hpp).
    if (mpm.left != scene::Wall::open) grid.walls_x.low = 1;
    if (mpm.right != scene::Wall::open) grid.walls_x.high = cells_x + 1;
    grid.walls_y.low = floor_row;

    const auto n = static_cast<std::size_t>(grid.nodes());
    grid.conditions.assign(n, 0);
    grid.friction.assign(grid.columns, 0.0);
    // No zones at all mean a floor that holds soil; between zones it is frictionless.
    const bool slips = !mpm.floor.friction.empty();
    const std::uint8_t on_floor =
        slips ? condition::floor : std::uint8_t{condition::hold_x | condition::hold_y};
    for (std::int32_t i = 0; i < grid.columns; ++i) {
        grid.conditions[i * grid.rows + floor_row] |= on_floor;
        grid.friction[i] = friction_at(mpm.floor.friction, grid.origin.x() + i * h, 1e-6 * h);
    }
    for (std::int32_t j = 0; j < grid.rows; ++j) {
        grid.conditions[grid.rows + j] |= wall_condition(mpm.left);
        grid.conditions[(cells_x + 1) * grid.rows + j] |= wall_condition(mpm.right);
    }
    if (!mpm.terrain.empty()) lay_terrain(grid, mpm);
    constexpr std::size_t wide = 4;  // rows of masses are accessed four at a time
    grid.mass.assign(n + wide, 0.0);
    grid.motion.assign(n, Lane::Zero());
    return grid;
}

void clear(Grid& grid) {
    for (const std::int32_t node : grid.active) {
        grid.mass[node] = 0.0;
        grid.motion[node].setZero();
    }
}

}  // namespace breach::mpm
