// Particle to grid. Compiled once per instruction set.
#pragma once

#include "mpm_solver/loops/loop_blocks.hpp"

namespace breach::mpm {

enum class Scattered { momentum_and_force, momentum, momentum_alone, force };

/// What a point gives to node (i, j) of its nine. With the velocity w at the first node, the
/// momentum m N (v + L (x_ij - x_p)) = m Nx_i Ny_j (w + i h L_x + j h L_y) and the force
/// -V sigma grad N are both of the form P_i Ny_j + Q_i M_j:
///     P_i = S_i (A + i B),  A = (m w, f_x.),  B = (m h L_x, 0),  S_i = (Nx_i, Nx_i, dNx_i, dNx_i)
///     Q_i = Nx_i C,         C = (m h L_y, f_y.),         M_j = (j Ny_j, j Ny_j, dNy_j, dNy_j)
template <int N>
struct Gifts {
    Quad<N> A[N];
    Quad<N> B[N];
    Quad<N> C[N];
    double m[N];
};

template <int N, Scattered what, Viscosity viscosity>
[[gnu::always_inline]] inline void fill_gifts(Gifts<N>& gifts, const ZoneWork& work,
                                              const PointArrays& a, std::size_t p,
                                              const Stencil<Lanes<N>>& sx,
                                              const Stencil<Lanes<N>>& sy) {
    using Real = Lanes<N>;
    constexpr bool forces = what == Scattered::momentum_and_force || what == Scattered::force;
    const Real none(0.0);
    const Real h(work.grid.h);
    Real mwx = none, mwy = none, mLxx = none, mLxy = none, mLyx = none, mLyy = none;
    Real Lxx = none, Lxy = none, Lyx = none, Lyy = none;
    if constexpr (what != Scattered::force || viscosity == Viscosity::newtonian) {
        Lxx = load<Real>(a.Lxx + p), Lxy = load<Real>(a.Lxy + p);
        Lyx = load<Real>(a.Lyx + p), Lyy = load<Real>(a.Lyy + p);
    }
    if constexpr (what != Scattered::force) {
        const Real m = load<Real>(a.m + p);
        store(gifts.m, m);
        const Real mh = m * h;
        mLxx = mh * Lxx, mLxy = mh * Lxy, mLyx = mh * Lyx, mLyy = mh * Lyy;
        const Real dx = sx.first - sx.centre;
        const Real dy = sy.first - sy.centre;
        mwx = m * load<Real>(a.vx + p) + mLxx * dx + mLxy * dy;
        mwy = m * load<Real>(a.vy + p) + mLyx * dx + mLyy * dy;
    }
    Real fxx = none, fyy = none, fxy = none;
    if constexpr (forces) {
        const Real share = load<Real>(a.V + p) * Real(-work.grid.per_h);
        Real xx = load<Real>(a.sxx + p);
        Real yy = load<Real>(a.syy + p);
        Real xy = load<Real>(a.sxy + p);
        if constexpr (viscosity == Viscosity::newtonian) {
            const Real eta(work.eta);
            const Real two_eta(2.0 * work.eta);
            const Real mean = (Lxx + Lyy) * Real(1.0 / 3.0);
            xx = xx + two_eta * (Lxx - mean);
            yy = yy + two_eta * (Lyy - mean);
            xy = xy + eta * (Lxy + Lyx);
        }
        fxx = share * xx, fyy = share * yy, fxy = share * xy;
    }
    to_points(mwx, mwy, fxx, fxy, gifts.A);
    to_points(mLxx, mLyx, none, none, gifts.B);
    to_points(mLxy, mLyy, fxy, fyy, gifts.C);
}

template <int N, Scattered what>
[[gnu::always_inline]] inline void give(const GridArrays& grid, const Weights<N>& w,
                                        const Gifts<N>& gifts, int k) {
    constexpr bool masses = what == Scattered::momentum_and_force || what == Scattered::momentum;
    using Four = Quad<N>;
    const Four Ny[3] = {Four(w.Ny[0][k]), Four(w.Ny[1][k]), Four(w.Ny[2][k])};
    const Four M[3] = {halves(Four(0.0), Four(w.dNy[0][k])), halves(Ny[1], Four(w.dNy[1][k])),
                       halves(Ny[2] + Ny[2], Four(w.dNy[2][k]))};
    const Four row_of_N = first_of(Ny[0], Ny[1], Ny[2]);
    Four A = gifts.A[k];
    const Four B = gifts.B[k];
    const Four C = gifts.C[k];
    const std::int64_t node = w.node[k];
    double* motion = grid.motion + 4 * node;
    double* mass = grid.mass + node;
    const Four m(gifts.m[k]);
    for (int i = 0; i < 3; ++i) {
        const Four Nx(w.Nx[i][k]);
        const Four P = halves(Nx, Four(w.dNx[i][k])) * A;
        const Four Q = Nx * C;
        for (int j = 0; j < 3; ++j) {
            store(motion + 4 * j, load<Four>(motion + 4 * j) + P * Ny[j] + Q * M[j]);
        }
        if constexpr (masses) store(mass, load<Four>(mass) + (m * Nx) * row_of_N);
        A = A + B;
        motion += 4 * grid.rows;
        mass += grid.rows;
    }
}

template <class Isa, class Kernel, Scattered what, Viscosity viscosity>
void scatter(const ZoneWork& work, Span span, Totals&) {
    constexpr int N = Isa::lanes;
    using Real = Lanes<N>;
    const Kernel kernel = kernel_of<Kernel>(work);
    const GridArrays grid = work.grid;
    for_each_block<Isa>(
        work.points, span, [&](const Block& block) __attribute__((always_inline)) {
            const auto& [a, p, first, count] = block;
            const Real xi = (load<Real>(a.x + p) - Real(grid.x_0)) * Real(grid.per_h);
            const Real eta = (load<Real>(a.y + p) - Real(grid.y_0)) * Real(grid.per_h);
            const Stencil<Real> sx = kernel(xi, grid.walls_x);
            const Stencil<Real> sy = kernel(eta, grid.walls_y);
            const Weights<N> weights(sx, sy, grid.rows);
            Gifts<N> gifts;
            fill_gifts<N, what, viscosity>(gifts, work, a, p, sx, sy);
            for (int k = 0; k < count; ++k) give<N, what>(grid, weights, gifts, k);
        });
}

}  // namespace breach::mpm
