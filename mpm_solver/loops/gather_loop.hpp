// Grid to particle. Compiled once per instruction set.
// Called by grid_to_particle for each zone and strip, after the nodes' momentum was updated: nodes
// have their velocity at the end of the step and its change.
#pragma once

#include "mpm_solver/loops/loop_blocks.hpp"

namespace breach::mpm {

/// Nodal motion (vx, vy, dvx, dvy) at the points of a block, and its derivatives per cell.
template <int N>
struct Gathered {
    Lanes<N> vx, vy, dvx, dvy;
    Lanes<N> Lxx, Lyx, Lxy, Lyy;  ///< times h
};

/// Adds the nodes of point k: the value, and d/dx and d/dy of vx and vy.
template <int N>
[[gnu::always_inline]] inline void gather_point(const GridArrays& grid, const Weights<N>& w, int k,
                                                Quad<N>& value, Quad<N>& gradient) {
    using Four = Quad<N>;
    const double* motion = grid.motion + 4 * static_cast<std::int64_t>(w.node[k]);
    value = Four(0.0);
    Four d_x(0.0);
    Four d_y(0.0);
    for (int i = 0; i < 3; ++i) {
        const Four node[3] = {load<Four>(motion), load<Four>(motion + 4), load<Four>(motion + 8)};
        const Four column =
            node[0] * Four(w.Ny[0][k]) + node[1] * Four(w.Ny[1][k]) + node[2] * Four(w.Ny[2][k]);
        const Four d_column =
            node[0] * Four(w.dNy[0][k]) + node[1] * Four(w.dNy[1][k]) + node[2] * Four(w.dNy[2][k]);
        value = value + column * Four(w.Nx[i][k]);
        d_x = d_x + column * Four(w.dNx[i][k]);
        d_y = d_y + d_column * Four(w.Nx[i][k]);
        motion += 4 * grid.rows;
    }
    gradient = low_halves(d_x, d_y);
}
/// The same with registers of eight: a column's values beside its d/dy.
[[gnu::always_inline]] inline void gather_point(const GridArrays& grid, const Weights<8>& w, int k,
                                                Lanes<4>& value, Lanes<4>& gradient) {
    using Four = Lanes<4>;
    using Eight = Lanes<8>;
    const double* motion = grid.motion + 4 * static_cast<std::int64_t>(w.node[k]);
    const Eight y[3] = {joined(Four(w.Ny[0][k]), Four(w.dNy[0][k])),
                        joined(Four(w.Ny[1][k]), Four(w.dNy[1][k])),
                        joined(Four(w.Ny[2][k]), Four(w.dNy[2][k]))};
    Eight value_and_d_y(0.0);
    Four d_x(0.0);
    for (int i = 0; i < 3; ++i) {
        const Eight column = twice(load<Four>(motion)) * y[0] +
                             twice(load<Four>(motion + 4)) * y[1] +
                             twice(load<Four>(motion + 8)) * y[2];
        value_and_d_y = value_and_d_y + column * Eight(w.Nx[i][k]);
        d_x = d_x + low_four(column) * Four(w.dNx[i][k]);
        motion += 4 * grid.rows;
    }
    value = low_four(value_and_d_y);
    gradient = low_halves(d_x, high_four(value_and_d_y));
}

template <int N>
[[gnu::always_inline]] inline Gathered<N> gathered(const GridArrays& grid, const Weights<N>& w) {
    Quad<N> values[N];
    Quad<N> gradients[N];
    for (int k = 0; k < N; ++k) gather_point(grid, w, k, values[k], gradients[k]);
    Gathered<N> at;
    from_points(values, at.vx, at.vy, at.dvx, at.dvy);
    from_points(gradients, at.Lxx, at.Lyx, at.Lxy, at.Lyy);
    return at;
}

/// Velocity that moves the points: at their own position, which at walls is not the centroid of
/// their domain. Nodal velocities are bilinear there, so value, gradient and (in corners) the mixed
/// derivative give it exactly: a point on a wall stays on it. dx, dy: position minus centroid
/// [cells].
template <int N>
[[gnu::always_inline]] inline void move_to_place(const GridArrays& grid, const Weights<N>& w,
                                                 const Gathered<N>& at, const Lanes<N>& dx,
                                                 const Lanes<N>& dy, Lanes<N>& vx, Lanes<N>& vy) {
    using Real = Lanes<N>;
    Real mixed_x(0.0);
    Real mixed_y(0.0);
    for (int k = 0; k < N; ++k) {
        const double* motion = grid.motion + 4 * static_cast<std::int64_t>(w.node[k]);
        for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j) {
                const double* node = motion + 4 * (i * grid.rows + j);
                const double weight = w.dNx[i][k] * w.dNy[j][k];
                mixed_x.v[k] += node[0] * weight;
                mixed_y.v[k] += node[1] * weight;
            }
        }
    }
    vx = vx + at.Lxx * dx + at.Lxy * dy + mixed_x * (dx * dy);
    vy = vy + at.Lyx * dx + at.Lyy * dy + mixed_y * (dx * dy);
}

template <class Real>
[[gnu::always_inline]] inline materials::MaskOf<Real> differs_from_zero(const Real& a) {
    return (a < Real(0.0)) | (a > Real(0.0));
}

/// The points' gradient from the nodes' velocities.
template <int N>
[[gnu::always_inline]] inline void set_gradient(const PointArrays& a, std::size_t p,
                                                const Gathered<N>& at, double per_h) {
    const Lanes<N> scale(per_h);
    store(a.Lxx + p, at.Lxx * scale);
    store(a.Lyx + p, at.Lyx * scale);
    store(a.Lxy + p, at.Lxy * scale);
    store(a.Lyy + p, at.Lyy * scale);
}

/// Anti-locking: adds volume and volume rate of the points to their cells' sums.
template <int N>
[[gnu::always_inline]] inline void add_to_cells(CellSum* cells, const PointArrays& a, std::size_t p,
                                                const Gathered<N>& at, double per_h, int count) {
    const auto V = load<Lanes<N>>(a.V + p);
    const Lanes<N> rate = V * ((at.Lxx + at.Lyy) * Lanes<N>(per_h));
    for (int k = 0; k < count; ++k) {
        CellSum& sum = cells[a.cell[p + k]];
        sum.V += V.v[k];
        sum.trD += rate.v[k];
    }
}

/// Moves the points; records the largest move and points that left the grid.
template <int N>
[[gnu::always_inline]] inline void move(const ZoneWork& work, const Block& block, const Lanes<N>& x,
                                        const Lanes<N>& y, const Lanes<N>& vx, const Lanes<N>& vy,
                                        Lanes<N>& farthest, Totals& sums) {
    using namespace materials::lanes;
    using Real = Lanes<N>;
    const Real dt(work.dt);
    const Real dx = dt * vx;
    const Real dy = dt * vy;
    const Real new_x = x + dx;
    const Real new_y = y + dy;
    store(block.arrays.x + block.p, new_x);
    store(block.arrays.y + block.p, new_y);
    farthest = larger(larger(magnitude(dx), magnitude(dy)), farthest);
    const GridArrays& grid = work.grid;
    const auto stays = (new_x >= Real(grid.low_x)) & (new_x <= Real(grid.high_x)) &
                       (new_y >= Real(grid.low_y)) & (new_y <= Real(grid.high_y));
    if (any(!stays)) [[unlikely]] {
        for (int k = 0; k < block.count; ++k) {
            const std::size_t p = block.first + k;
            if (!lane(stays, k) && p < sums.lost) sums.lost = p;
        }
    }
}

/// Updates velocity (affine FLIP relaxed to affine PIC at the rate beta), velocity gradient and
/// position of the points.
template <class Isa, Averages averages>
void gather(const ZoneWork& work, Span span, Totals& sums) {
    using namespace materials::lanes;
    constexpr int N = Isa::lanes;
    using Real = Lanes<N>;
    const GimpKernel kernel(work.gimp_half_size);
    const GridArrays grid = work.grid;
    const Real blend(work.blend);
    const Real keep(1.0 - work.blend);
    Real kinetic(0.0);
    Real fastest(0.0);
    Real farthest(0.0);
    for_each_block<Isa>(
        work.points, span, [&](const Block& block) __attribute__((always_inline)) {
            const auto& [a, p, first, count] = block;
            ask_ahead(block, {a.x, a.y, a.vx, a.vy, a.m, a.V, a.Lxx, a.Lxy, a.Lyx, a.Lyy});
            const Real x = load<Real>(a.x + p);
            const Real y = load<Real>(a.y + p);
            const Real xi = (x - Real(grid.x_0)) * Real(grid.per_h);
            const Real eta = (y - Real(grid.y_0)) * Real(grid.per_h);
            const Stencil<Real> sx = kernel(xi, grid.walls_x);
            const Stencil<Real> sy = kernel(eta, grid.walls_y);
            const Weights<N> weights(sx, sy, grid.rows);
            const Gathered<N> at = gathered(grid, weights);

            // FLIP keeps the point's own velocity and adds the change; PIC takes the grid's. A
            // share per step would make the result depend on dt, therefore blend is a rate times
            // dt.
            const Real vx = keep * (load<Real>(a.vx + p) + at.dvx) + blend * at.vx;
            const Real vy = keep * (load<Real>(a.vy + p) + at.dvy) + blend * at.vy;
            store(a.vx + p, vx);
            store(a.vy + p, vy);
            const Real v2 = vx * vx + vy * vy;
            const auto own = own_lanes<Real>(block);
            // A tail's other lanes repeat its last point: harmless for a maximum, wrong in a sum.
            kinetic = kinetic + select(own, Real(0.5) * load<Real>(a.m + p) * v2, Real(0.0));
            fastest = larger(v2, fastest);
            set_gradient(a, p, at, grid.per_h);

            // Points move with the grid's velocity: their own has the noise that FLIP leaves.
            Real moving_x = at.vx;
            Real moving_y = at.vy;
            const Real dx = xi - sx.centre;
            const Real dy = eta - sy.centre;
            if (any(differs_from_zero(dx) | differs_from_zero(dy))) [[unlikely]] {
                move_to_place(grid, weights, at, dx, dy, moving_x, moving_y);
            }
            if constexpr (averages == Averages::per_cell) {
                // Before the move: stress() reads the average of the cell that this sum went to.
                store<N>(a.cell + p, integers(xi) * grid.rows + integers(eta));
                add_to_cells(work.cells, a, p, at, grid.per_h, count);
            }
            move(work, block, x, y, moving_x, moving_y, farthest, sums);
        });
    sums.kinetic += sum_of(kinetic);
    sums.fastest_squared = largest_of(larger(fastest, Real(sums.fastest_squared)));
    sums.farthest = largest_of(larger(farthest, Real(sums.farthest)));
}

}  // namespace breach::mpm
