#include <algorithm>
#include <cmath>

#include "mpm_solver/step.hpp"

namespace breach::mpm {

namespace {

using scene::AntiLocking;
using scene::UpdateOrder;

/// Nodal motion (vx, vy, dvx, dvy) at a point and its derivatives per cell.
struct Gathered {
    Lane value;
    Lane d_x;
    Lane d_y;
};

Gathered gather(const Grid& grid, const Stencil& sx, const Stencil& sy) {
    Gathered sum{Lane::Zero(), Lane::Zero(), Lane::Zero()};
    for (int i = 0; i < 3; ++i) {
        const Lane* node = &grid.motion[(sx.first + i) * grid.rows + sy.first];
        const Lane column = node[0] * sy.N[0] + node[1] * sy.N[1] + node[2] * sy.N[2];
        const Lane d_column = node[0] * sy.dN[0] + node[1] * sy.dN[1] + node[2] * sy.dN[2];
        sum.value += column * sx.N[i];
        sum.d_x += column * sx.dN[i];
        sum.d_y += d_column * sx.N[i];
    }
    return sum;
}

void set_gradient(Points& points, std::size_t p, const Gathered& at, double per_h) {
    points.Lxx[p] = at.d_x[0] * per_h;
    points.Lyx[p] = at.d_x[1] * per_h;
    points.Lxy[p] = at.d_y[0] * per_h;
    points.Lyy[p] = at.d_y[1] * per_h;
}

void forget(CellAverages& averages) {
    for (const std::int32_t cell : averages.filled) averages.sums[cell] = {};
    averages.filled.clear();
}

void add_to_cell(CellAverages& averages, std::int32_t cell, double V, double trD) {
    CellSum& sum = averages.sums[cell];
    if (sum.V == 0.0) averages.filled.push_back(cell);
    sum.V += V;
    sum.trD += V * trD;
}

/// Velocity that moves the point: that of its own place, which at walls is not its domain's
/// centroid. Nodal velocities are bilinear there, so value, gradient and (in corners) the mixed
/// derivative give it exactly: a point on a wall stays on it.
Vec2 velocity_at_place(const Grid& grid, const Stencil& sx, const Stencil& sy, const Gathered& at,
                       double xi, double eta) {
    const double dx = xi - sx.centre;
    const double dy = eta - sy.centre;
    Lane v = at.value + at.d_x * dx + at.d_y * dy;
    if (dx != 0.0 && dy != 0.0) {
        for (int i = 0; i < 3; ++i) {
            const Lane* node = &grid.motion[(sx.first + i) * grid.rows + sy.first];
            for (int j = 0; j < 3; ++j) v += node[j] * (sx.dN[i] * sy.dN[j] * dx * dy);
        }
    }
    return {v[0], v[1]};
}

}  // namespace

template <class Kernel, UpdateOrder order, AntiLocking anti_locking>
void grid_to_particle(Body& body, double dt) {
    const Grid& grid = body.grid;
    Points& points = body.points;
    const Kernel kernel = kernel_of<Kernel>(body);
    const double blend = std::min(body.blending_rate * dt, 1.0);
    double kinetic = 0.0;
    double fastest = 0.0;
    for (std::size_t z = 0; z < body.zones.size(); ++z) {
        if constexpr (anti_locking == AntiLocking::on) forget(body.averages[z]);
        for (std::size_t p = body.zones[z].begin; p < body.zones[z].end; ++p) {
            const double xi = grid.xi(points.x[p]);
            const double eta = grid.eta(points.y[p]);
            const Stencil sx = kernel(xi, grid.walls_x);
            const Stencil sy = kernel(eta, grid.walls_y);
            const Gathered at = gather(grid, sx, sy);
            points.cell[p] = grid.cell(xi, eta);

            points.vx[p] = (1.0 - blend) * (points.vx[p] + at.value[2]) + blend * at.value[0];
            points.vy[p] = (1.0 - blend) * (points.vy[p] + at.value[3]) + blend * at.value[1];
            set_gradient(points, p, at, grid.per_h);
            const Vec2 v = velocity_at_place(grid, sx, sy, at, xi, eta);
            if constexpr (order == UpdateOrder::usl) {
                points.x[p] += dt * v.x();
                points.y[p] += dt * v.y();
                if (!grid.holds(points.x[p], points.y[p])) body.tally.lost = p;
                if constexpr (anti_locking == AntiLocking::on) {
                    add_to_cell(body.averages[z], points.cell[p], points.V[p],
                                points.Lxx[p] + points.Lyy[p]);
                }
            } else {
                body.drift_x[p] = v.x();
                body.drift_y[p] = v.y();
            }
            const double v2 = points.vx[p] * points.vx[p] + points.vy[p] * points.vy[p];
            kinetic += 0.5 * points.m[p] * v2;
            fastest = std::max(fastest, v2);
        }
    }
    body.tally.kinetic = kinetic;
    body.tally.fastest = std::sqrt(fastest);
}

namespace {

/// Momentum m N_i (v + L (x_i - x_p)) of every point onto the nodes; the masses are there already.
template <class Kernel>
void scatter_momentum(Body& body) {
    Grid& grid = body.grid;
    const Points& points = body.points;
    const Kernel kernel = kernel_of<Kernel>(body);
    for (const std::int32_t node : grid.active) grid.motion[node].setZero();
    for (std::size_t p = 0; p < points.size(); ++p) {
        const Stencil sx = kernel(grid.xi(points.x[p]), grid.walls_x);
        const Stencil sy = kernel(grid.eta(points.y[p]), grid.walls_y);
        for (int i = 0; i < 3; ++i) {
            const double dx = (sx.first + i - sx.centre) * grid.h;
            Lane* node = &grid.motion[(sx.first + i) * grid.rows + sy.first];
            for (int j = 0; j < 3; ++j) {
                const double dy = (sy.first + j - sy.centre) * grid.h;
                const double mN = points.m[p] * sx.N[i] * sy.N[j];
                node[j][0] += mN * (points.vx[p] + points.Lxx[p] * dx + points.Lxy[p] * dy);
                node[j][1] += mN * (points.vy[p] + points.Lyx[p] * dx + points.Lyy[p] * dy);
            }
        }
    }
}

/// Momentum to velocity; nothing may go through walls or floor. Friction has done its work already.
void hold_velocities(Grid& grid) {
    for (const std::int32_t node : grid.active) {
        if (grid.mass[node] <= 0.0) continue;
        Lane& v = grid.motion[node];
        v /= grid.mass[node];
        const std::uint8_t must = grid.conditions[node];
        if (must & condition::floor) v[1] = std::max(v[1], 0.0);
        if (must & condition::terrain) {
            v.head<2>() = kept_out(grid.contacts[grid.contact_of[node]], {v[0], v[1]}).array();
        }
        if (must & condition::hold_x) v[0] = 0.0;
        if (must & condition::hold_y) v[1] = 0.0;
    }
}

}  // namespace

template <class Kernel, AntiLocking anti_locking>
void map_again(Body& body, double dt) {
    scatter_momentum<Kernel>(body);
    hold_velocities(body.grid);
    const Grid& grid = body.grid;
    Points& points = body.points;
    const Kernel kernel = kernel_of<Kernel>(body);
    for (std::size_t z = 0; z < body.zones.size(); ++z) {
        for (std::size_t p = body.zones[z].begin; p < body.zones[z].end; ++p) {
            const Stencil sx = kernel(grid.xi(points.x[p]), grid.walls_x);
            const Stencil sy = kernel(grid.eta(points.y[p]), grid.walls_y);
            set_gradient(points, p, gather(grid, sx, sy), grid.per_h);
            points.x[p] += dt * body.drift_x[p];
            points.y[p] += dt * body.drift_y[p];
            if (!grid.holds(points.x[p], points.y[p])) body.tally.lost = p;
            if constexpr (anti_locking == AntiLocking::on) {
                add_to_cell(body.averages[z], points.cell[p], points.V[p],
                            points.Lxx[p] + points.Lyy[p]);
            }
        }
    }
}

using enum scene::UpdateOrder;
template void grid_to_particle<GimpKernel, usl, AntiLocking::on>(Body&, double);
template void grid_to_particle<GimpKernel, usl, AntiLocking::off>(Body&, double);
template void grid_to_particle<GimpKernel, musl, AntiLocking::on>(Body&, double);
template void grid_to_particle<GimpKernel, musl, AntiLocking::off>(Body&, double);
template void grid_to_particle<BSplineKernel, usl, AntiLocking::on>(Body&, double);
template void grid_to_particle<LinearKernel, usl, AntiLocking::on>(Body&, double);
template void grid_to_particle<BSplineKernel, usl, AntiLocking::off>(Body&, double);
template void grid_to_particle<LinearKernel, usl, AntiLocking::off>(Body&, double);
template void grid_to_particle<BSplineKernel, musl, AntiLocking::on>(Body&, double);
template void grid_to_particle<LinearKernel, musl, AntiLocking::on>(Body&, double);
template void grid_to_particle<BSplineKernel, musl, AntiLocking::off>(Body&, double);
template void grid_to_particle<LinearKernel, musl, AntiLocking::off>(Body&, double);
template void map_again<GimpKernel, AntiLocking::on>(Body&, double);
template void map_again<GimpKernel, AntiLocking::off>(Body&, double);
template void map_again<BSplineKernel, AntiLocking::on>(Body&, double);
template void map_again<LinearKernel, AntiLocking::on>(Body&, double);
template void map_again<BSplineKernel, AntiLocking::off>(Body&, double);
template void map_again<LinearKernel, AntiLocking::off>(Body&, double);

}  // namespace breach::mpm
