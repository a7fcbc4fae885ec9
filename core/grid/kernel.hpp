// One-dimensional shape functions of a material point over three neighbouring nodes; its weight at
// a grid node is the product of one in x and one in y. Lengths in cells; clipped at walls and
// floor. One formula for one point (Real = double) or several side by side (Real = Lanes).
#pragma once

#include <cstdint>
#include <limits>

#include "core/materials/lanes.hpp"

namespace breach::grid {

/// Weights of the nodes first, first + 1, first + 2 and their derivatives [1/cell]. They sum to 1
/// (derivatives to 0) and reproduce a linear field about `centre`, the centroid of the point's
/// domain [cells]. `first` is a whole number.
template <class Real>
struct Stencil {
    Real first;
    Real N[3];
    Real dN[3];
    Real centre;
};

/// Node rows with a wall, at which the domains of points are clipped; by default none. For one
/// soil, the high row can be the top of its bed (core/scene/beds.hpp); it does not affect points
/// beyond it.
struct WallRows {
    std::int32_t low = std::numeric_limits<std::int32_t>::min();
    std::int32_t high = std::numeric_limits<std::int32_t>::max();
};

/// The nearest whole number; |a| < 2^51.
template <class Real>
[[gnu::always_inline]] inline Real nearest_whole(const Real& a) {
    return (a + Real(materials::lanes::to_integer)) - Real(materials::lanes::to_integer);
}

/// The node row nearest to a point, and whether it is a wall.
template <class Real>
struct NearestRow {
    Real row;
    Real d;  ///< distance of the point from that row [cells]
    materials::MaskOf<Real> low_wall;
    materials::MaskOf<Real> high_wall;

    [[gnu::always_inline]] NearestRow(const Real& xi, const WallRows& walls)
        : row(nearest_whole(xi)),
          d(xi - row),
          low_wall((row >= Real(walls.low)) & (row <= Real(walls.low)) & (d >= Real(-beside))),
          high_wall((row >= Real(walls.high)) & (row <= Real(walls.high)) & (d <= Real(beside))) {}

    static constexpr double beside = 1e-6;  ///< tolerance for a point on a wall [cells]
};

/// Hat functions at the nearest row, exact for a domain that ends there; the kernel reduces to them
/// at a wall. `reach` >= 0: distance of the centroid from the wall [cells].
template <class Real>
[[gnu::always_inline]] inline void clip_at_low_wall(Stencil<Real>& s,
                                                    const materials::MaskOf<Real>& where,
                                                    const Real& reach) {
    using materials::lanes::select;
    s.N[0] = select(where, Real(0.0), s.N[0]);
    s.N[1] = select(where, Real(1.0) - reach, s.N[1]);
    s.N[2] = select(where, reach, s.N[2]);
    s.dN[0] = select(where, Real(0.0), s.dN[0]);
    s.dN[1] = select(where, Real(-1.0), s.dN[1]);
    s.dN[2] = select(where, Real(1.0), s.dN[2]);
    s.centre = select(where, (s.first + Real(1.0)) + reach, s.centre);
}
template <class Real>
[[gnu::always_inline]] inline void clip_at_high_wall(Stencil<Real>& s,
                                                     const materials::MaskOf<Real>& where,
                                                     const Real& reach) {
    using materials::lanes::select;
    s.N[0] = select(where, reach, s.N[0]);
    s.N[1] = select(where, Real(1.0) - reach, s.N[1]);
    s.N[2] = select(where, Real(0.0), s.N[2]);
    s.dN[0] = select(where, Real(-1.0), s.dN[0]);
    s.dN[1] = select(where, Real(1.0), s.dN[1]);
    s.dN[2] = select(where, Real(0.0), s.dN[2]);
    s.centre = select(where, (s.first + Real(1.0)) - reach, s.centre);
}

/// GIMP (Bardenhagen & Kober 2004): the hat function averaged over a domain of constant half size
/// l. Domains are clipped at a wall, which keeps partition of unity and gradients of linear fields
/// exact.
class GimpKernel {
  public:
    /// half_size: l [cells] in (0, 0.5].
    [[gnu::always_inline]] explicit GimpKernel(double half_size)
        : l_(half_size), half_over_l_(0.5 / half_size), quarter_over_l_(0.25 / half_size) {}

    /// xi: position > 0 from the first (ghost) node row [cells].
    template <class Real>
    [[gnu::always_inline]] Stencil<Real> operator()(const Real& xi, const WallRows& walls) const {
        using namespace materials::lanes;
        const NearestRow<Real> at(xi, walls);
        const Real& d = at.d;
        const Real l(l_);
        const Real e = larger(smaller(d, l), -l);
        const Real to_right = l + e;
        const Real to_left = l - e;
        const Real right = to_right * to_right * Real(quarter_over_l_) + positive(d - l);
        const Real left = to_left * to_left * Real(quarter_over_l_) + positive(-d - l);
        const Real d_right = to_right * Real(half_over_l_);
        const Real d_left = -to_left * Real(half_over_l_);
        Stencil<Real> s{at.row - Real(1.0),
                        {left, Real(1.0) - left - right, right},
                        {d_left, -d_left - d_right, d_right},
                        xi};
        const materials::MaskOf<Real> low = at.low_wall & (d < l);
        const materials::MaskOf<Real> high = at.high_wall & (-d < l);
        if (any(materials::MaskOf<Real>(low | high))) [[unlikely]] {
            clip_at_low_wall(s, low, Real(0.5) * (d + l));
            clip_at_high_wall(s, high, Real(0.5) * (l - d));
        }
        return s;
    }

  private:
    double l_;
    double half_over_l_;
    double quarter_over_l_;
};

}  // namespace breach::grid
