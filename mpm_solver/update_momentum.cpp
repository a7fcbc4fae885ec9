#include <algorithm>
#include <cmath>

#include "mpm_solver/step.hpp"

namespace breach::mpm {

namespace {

/// Coulomb friction of a node that presses on the floor: the impulse that stops it is at most mu
/// times the normal one. Returns the work that friction takes, impulse x (v_before + v_after) / 2
/// [J], exact for the node's kinetic energy.
double rub(double m, double mu, const Vec2& v_before, Vec2& v) {
    if (v.y() >= 0.0) return 0.0;  // lifts off
    const double normal = -m * v.y();
    v.y() = 0.0;
    const double free_vx = v.x();
    const double most = mu * normal / m;
    v.x() = std::copysign(std::max(std::abs(free_vx) - most, 0.0), free_vx);
    return m * (free_vx - v.x()) * 0.5 * (v_before.x() + v.x());
}

}  // namespace

void update_momentum(Body& body, double dt) {
    Grid& grid = body.grid;
    double friction_work = 0.0;
    for (const std::int32_t node : grid.active) {
        const double m = grid.mass[node];
        if (m <= 0.0) {
            grid.motion[node].setZero();
            continue;
        }
        const Lane motion = grid.motion[node] / m;
        const Vec2 v_before{motion[0], motion[1]};
        Vec2 v = v_before + dt * (Vec2{motion[2], motion[3]} + body.gravity);
        if (const std::uint8_t must = grid.conditions[node]; must != 0) {
            if (must & condition::floor) {
                friction_work += rub(m, grid.friction[node / grid.rows], v_before, v);
            }
            if (must & condition::terrain) {
                friction_work += rub(grid.contacts[grid.contact_of[node]], m, v_before, v);
            }
            if (must & condition::hold_x) v.x() = 0.0;
            if (must & condition::hold_y) v.y() = 0.0;
        }
        grid.motion[node] << v.x(), v.y(), v.x() - v_before.x(), v.y() - v_before.y();
    }
    body.tally.friction += friction_work;
}

}  // namespace breach::mpm
