// Particle to grid. Compiled once per instruction set.
// Called by particle_to_grid. A node has four numbers side by side, momentum and force: one vector
// operation adds both components of both.
#pragma once

#include "mpm_solver/loops/loop_blocks.hpp"

namespace breach::mpm {

/// -grad p of standing water at a block's points: bilinear between nodes, 0 where p is not positive.
/// xi, eta: places in cells from the first node. Only the reads are point by point.
template <int N>
[[gnu::always_inline]] inline void still_pull(const GridArrays& grid, const Lanes<N>& xi,
                                              const Lanes<N>& eta, Lanes<N>& x, Lanes<N>& y) {
    using namespace materials::lanes;
    using Real = Lanes<N>;
    const Integers<N> i = integers(xi), j = integers(eta);
    const Integers<N> cell = i * grid.rows + j;
    Real left(0.0), left_up(0.0), right(0.0), right_up(0.0);
    for (int k = 0; k < N; ++k) {
        const double* node = grid.still + cell[k];
        left.v[k] = node[0], left_up.v[k] = node[1];
        right.v[k] = node[grid.rows], right_up.v[k] = node[grid.rows + 1];
    }
    Real column, row;
    column.v = __builtin_convertvector(i, typename Real::Vector);
    row.v = __builtin_convertvector(j, typename Real::Vector);
    const Real tx = xi - column, ty = eta - row;
    const Real up_left = left_up - left, up_right = right_up - right;
    const Real p_left = left + ty * up_left;
    const Real slope = right + ty * up_right - p_left;
    const Real wet = select(p_left + tx * slope > Real(0.0), Real(-grid.per_h), Real(0.0));
    x = wet * slope;
    y = wet * (up_left + tx * (up_right - up_left));
}

/// Contribution of a point to node (i, j) of its nine. With the velocity w at the first node, the
/// momentum m N (v + L (x_ij - x_p)) = m Nx_i Ny_j (w + i h L_x + j h L_y) and the force
/// -V sigma grad N are both of the form P_i Ny_j + Q_i M_j:
///     P_i = S_i (A + i B),  A = (m w, f_x.),  B = (m h L_x, 0),  S_i = (Nx_i, Nx_i, dNx_i, dNx_i)
///     Q_i = Nx_i C,         C = (m h L_y, f_y.),         M_j = (j Ny_j, j Ny_j, dNy_j, dNy_j)
/// In water P_i also has Nx_i D with the force D = (0, 0, -V grad p).
template <int N>
struct Gifts {
    Quad<N> A[N];
    Quad<N> B[N];
    Quad<N> C[N];
    Quad<N> D[N];  ///< in water only
    double m[N];
};

template <int N, Viscosity viscosity>
[[gnu::always_inline]] inline void fill_gifts(Gifts<N>& gifts, const ZoneWork& work,
                                              const PointArrays& a, std::size_t p,
                                              const Stencil<Lanes<N>>& sx,
                                              const Stencil<Lanes<N>>& sy) {
    using Real = Lanes<N>;
    const Real none(0.0);
    const Real h(work.grid.h);
    const Real Lxx = load<Real>(a.Lxx + p), Lxy = load<Real>(a.Lxy + p);
    const Real Lyx = load<Real>(a.Lyx + p), Lyy = load<Real>(a.Lyy + p);
    const Real m = load<Real>(a.m + p);
    store(gifts.m, m);
    const Real mh = m * h;
    const Real mLxx = mh * Lxx, mLxy = mh * Lxy, mLyx = mh * Lyx, mLyy = mh * Lyy;
    // From the centroid of the domain, not from the point: beside a wall, where the domain is
    // clipped, the weights reproduce linear fields about the centroid only.
    const Real dx = sx.first - sx.centre;
    const Real dy = sy.first - sy.centre;
    const Real mwx = m * load<Real>(a.vx + p) + mLxx * dx + mLxy * dy;
    const Real mwy = m * load<Real>(a.vy + p) + mLyx * dx + mLyy * dy;
    const Real share = load<Real>(a.V + p) * Real(-work.grid.per_h);
    Real xx = load<Real>(a.sxx + p);
    Real yy = load<Real>(a.syy + p);
    Real xy = load<Real>(a.sxy + p);
    // Beside the law's stress, and never stored in it: the law would return it to its yield
    // surface.
    if constexpr (viscosity == Viscosity::newtonian) {
        const Real eta = load<Real>(a.eta + p);
        const Real two_eta = eta + eta;
        const Real mean = (Lxx + Lyy) * Real(1.0 / 3.0);
        xx = xx + two_eta * (Lxx - mean);
        yy = yy + two_eta * (Lyy - mean);
        xy = xy + eta * (Lxy + Lyx);
    }
    const Real fxx = share * xx, fyy = share * yy, fxy = share * xy;
    to_points(mwx, mwy, fxx, fxy, gifts.A);
    to_points(mLxx, mLyx, none, none, gifts.B);
    to_points(mLxy, mLyy, fxy, fyy, gifts.C);
}

/// Standing water acts at the points and not at nodes: a point at the surface of water or soil
/// feels the pressure of its own place. It reaches the points' velocities by the nodes, as all
/// forces do: added to them directly, its changes within a cell would grow in modes that no node
/// sees (5 m/s in soil at rest below a kink of the water's line).
template <int N>
[[gnu::always_inline]] inline void fill_water(Gifts<N>& gifts, const ZoneWork& work,
                                              const PointArrays& a, std::size_t p,
                                              const Lanes<N>& xi, const Lanes<N>& eta) {
    Lanes<N> x, y;
    still_pull(work.grid, xi, eta, x, y);
    const Lanes<N> V = load<Lanes<N>>(a.displaced + p), none(0.0);
    to_points(none, none, V * x, V * y, gifts.D);
}

/// Contribution to a column of three nodes; `mass` of all three.
template <int N>
struct Column {
    Quad<N> low, middle, high;
    Quad<N> mass;
};

/// Location of a column.
struct ColumnPlace {
    double* motion;
    double* mass;

    [[gnu::always_inline]] ColumnPlace(const GridArrays& grid, std::int64_t node, int column)
        : motion(grid.motion + 4 * (node + column * static_cast<std::int64_t>(grid.rows))),
          mass(grid.mass + (node + column * static_cast<std::int64_t>(grid.rows))) {}
};

template <int N>
[[gnu::always_inline]] inline Column<N> load_column(const ColumnPlace& at) {
    using Four = Quad<N>;
    return {load<Four>(at.motion), load<Four>(at.motion + 4), load<Four>(at.motion + 8),
            load<Four>(at.mass)};
}
template <int N>
[[gnu::always_inline]] inline void store_column(const ColumnPlace& at, const Column<N>& column) {
    store(at.motion, column.low);
    store(at.motion + 4, column.middle);
    store(at.motion + 8, column.high);
    store(at.mass, column.mass);
}

/// Contribution of a point to its three columns.
template <int N, Medium medium>
class Giver {
    using Four = Quad<N>;

  public:
    [[gnu::always_inline]] Giver(const Weights<N>& w, const Gifts<N>& gifts, int k)
        : Ny_low_(w.Ny[0][k]),
          Ny_middle_(w.Ny[1][k]),
          Ny_high_(w.Ny[2][k]),
          M_low_(halves(Four(0.0), Four(w.dNy[0][k]))),
          M_middle_(halves(Ny_middle_, Four(w.dNy[1][k]))),
          M_high_(halves(Ny_high_ + Ny_high_, Four(w.dNy[2][k]))),
          m_Ny_(Four(gifts.m[k])),
          row_of_N_(first_of(Ny_low_, Ny_middle_, Ny_high_)),
          A_(gifts.A[k]),
          B_(gifts.B[k]),
          C_(gifts.C[k]) {
        if constexpr (medium == Medium::water) D_ = gifts.D[k];
    }

    /// Adds the contribution to the next column, from left to right.
    [[gnu::always_inline]] void give(Column<N>& column, double Nx_of_column, double dNx) {
        const Four Nx(Nx_of_column);
        Four P = halves(Nx, Four(dNx)) * A_;
        if constexpr (medium == Medium::water) P = P + Nx * D_;
        const Four Q = Nx * C_;
        column.low = column.low + P * Ny_low_ + Q * M_low_;
        column.middle = column.middle + P * Ny_middle_ + Q * M_middle_;
        column.high = column.high + P * Ny_high_ + Q * M_high_;
        column.mass = column.mass + (m_Ny_ * Nx) * row_of_N_;
        A_ = A_ + B_;
    }

  private:
    Four Ny_low_, Ny_middle_, Ny_high_;
    Four M_low_, M_middle_, M_high_;
    Four m_Ny_, row_of_N_;
    Four A_, B_, C_;
    Four D_;  ///< in water only
};

/// Sums contributions of points with the same nodes in registers, for CPUs with enough of them. The
/// order of points makes neighbours share nodes (strips.hpp).
template <Medium medium>
class Shared {
    static constexpr int N = 8;

  public:
    [[gnu::always_inline]] void take(const Weights<N>& w, const Gifts<N>& gifts, int k) {
        Giver<N, medium> giver(w, gifts, k);
        giver.give(left_, w.Nx[0][k], w.dNx[0][k]);
        giver.give(middle_, w.Nx[1][k], w.dNx[1][k]);
        giver.give(right_, w.Nx[2][k], w.dNx[2][k]);
    }
    [[gnu::always_inline]] void hand_over(const GridArrays& grid, std::int64_t node) {
        hand_over({grid, node, 0}, left_);
        hand_over({grid, node, 1}, middle_);
        hand_over({grid, node, 2}, right_);
    }

  private:
    [[gnu::always_inline]] static Column<N> none() {
        return {Lanes<4>(0.0), Lanes<4>(0.0), Lanes<4>(0.0), Lanes<4>(0.0)};
    }
    [[gnu::always_inline]] static void hand_over(const ColumnPlace& at, Column<N>& column) {
        const Column<N> had = load_column<N>(at);
        store_column<N>(at, {had.low + column.low, had.middle + column.middle,
                             had.high + column.high, had.mass + column.mass});
        column = none();
    }

    Column<N> left_ = none();
    Column<N> middle_ = none();
    Column<N> right_ = none();
};

template <Medium medium, int N>
[[gnu::always_inline]] inline void give_all(const GridArrays& grid, const Weights<N>& w,
                                            const Gifts<N>& gifts, int count) {
    if constexpr (N == 8) {
        Shared<medium> shared;
        for (int k = 0; k < count; ++k) {
            shared.take(w, gifts, k);
            // The sum leaves the registers when the next point has other nodes.
            if (k + 1 == count || w.node[k + 1] != w.node[k]) shared.hand_over(grid, w.node[k]);
        }
    } else {
        for (int k = 0; k < count; ++k) {
            Giver<N, medium> giver(w, gifts, k);
            for (int i = 0; i < 3; ++i) {
                const ColumnPlace at(grid, w.node[k], i);
                Column<N> column = load_column<N>(at);
                giver.give(column, w.Nx[i][k], w.dNx[i][k]);
                store_column<N>(at, column);
            }
        }
    }
}

template <class Isa, Viscosity viscosity, Medium medium>
void scatter(const ZoneWork& work, Span span, Totals&) {
    constexpr int N = Isa::lanes;
    using Real = Lanes<N>;
    const GimpKernel kernel(work.gimp_half_size);
    const GridArrays grid = work.grid;
    for_each_block<Isa>(
        work.points, span, [&](const Block& block) __attribute__((always_inline)) {
            const auto& [a, p, first, count] = block;
            ask_ahead(block, {a.x, a.y, a.vx, a.vy, a.m, a.V, a.Lxx, a.Lxy, a.Lyx, a.Lyy, a.sxx,
                              a.syy, a.sxy});
            const Real xi = (load<Real>(a.x + p) - Real(grid.x_0)) * Real(grid.per_h);
            const Real eta = (load<Real>(a.y + p) - Real(grid.y_0)) * Real(grid.per_h);
            const Stencil<Real> sx = kernel(xi, grid.walls_x);
            const Stencil<Real> sy = kernel(eta, grid.walls_y);
            const Weights<N> weights(sx, sy, grid.rows);
            Gifts<N> gifts;
            fill_gifts<N, viscosity>(gifts, work, a, p, sx, sy);
            if constexpr (medium == Medium::water) fill_water(gifts, work, a, p, xi, eta);
            give_all<medium, N>(grid, weights, gifts, count);
        });
}

}  // namespace breach::mpm
