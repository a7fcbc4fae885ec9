// One-dimensional shape functions of a point over three neighbouring nodes; a point's weight at a
// node is the product of one in x and one in y. Lengths in cells; wall-clipped near walls and
// floor.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

namespace breach::mpm {

/// Weights of the nodes first, first + 1, first + 2 and their derivatives [1/cell]. They always sum
/// to 1 (derivatives to 0), and reproduce a linear field about `centre`, the centroid of the
/// point's domain [cells].
struct Stencil {
    std::int32_t first;
    double N[3];
    double dN[3];
    double centre;
};

/// Node rows that carry a wall; a domain does not reach through them. Open ends lie out of reach.
struct WallRows {
    std::int32_t low = std::numeric_limits<std::int32_t>::min();
    std::int32_t high = std::numeric_limits<std::int32_t>::max();
};

/// GIMP (Bardenhagen & Kober 2004): the hat function averaged over a domain of fixed half size l.
/// Beside a wall the domain is clipped there, so that partition of unity and gradients of linear
/// fields stay exact.
class GimpKernel {
  public:
    /// half_size: l [cells] in (0, 0.5].
    explicit GimpKernel(double half_size)
        : l_(half_size), half_over_l_(0.5 / half_size), quarter_over_l_(0.25 / half_size) {}

    /// xi [cells] > 0 from the first (ghost) node row.
    Stencil operator()(double xi, const WallRows& walls) const {
        const auto nearest = static_cast<std::int32_t>(xi + 0.5);
        const double d = xi - nearest;
        if (nearest == walls.low && d < l_) {
            const double reach = 0.5 * (d + l_);
            return {nearest - 1, {0.0, 1.0 - reach, reach}, {0.0, -1.0, 1.0}, nearest + reach};
        }
        if (nearest == walls.high && -d < l_) {
            const double reach = 0.5 * (l_ - d);
            return {nearest - 1, {reach, 1.0 - reach, 0.0}, {-1.0, 1.0, 0.0}, nearest - reach};
        }
        const double e = std::clamp(d, -l_, l_);
        const double to_right = l_ + e;
        const double to_left = l_ - e;
        const double right = to_right * to_right * quarter_over_l_ + std::max(d - l_, 0.0);
        const double left = to_left * to_left * quarter_over_l_ + std::max(-d - l_, 0.0);
        const double d_right = to_right * half_over_l_;
        const double d_left = -to_left * half_over_l_;
        return {nearest - 1,
                {left, 1.0 - left - right, right},
                {d_left, -d_left - d_right, d_right},
                xi};
    }

  private:
    double l_;
    double half_over_l_;
    double quarter_over_l_;
};

/// Quadratic B-spline. Within half a cell of a wall the row beyond it is the linear continuation of
/// the two before (v_-1 = 2 v_0 - v_1), which makes the weights the hat functions: no row outside
/// is needed, value and slope go over smoothly, linear fields stay exact.
class BSplineKernel {
  public:
    Stencil operator()(double xi, const WallRows& walls) const {
        const auto nearest = static_cast<std::int32_t>(xi + 0.5);
        const double d = xi - nearest;
        if (nearest == walls.low) return {nearest - 1, {0.0, 1.0 - d, d}, {0.0, -1.0, 1.0}, xi};
        if (nearest == walls.high) return {nearest - 1, {-d, 1.0 + d, 0.0}, {-1.0, 1.0, 0.0}, xi};
        const double to_right = 0.5 + d;
        const double to_left = 0.5 - d;
        return {nearest - 1,
                {0.5 * to_left * to_left, 0.75 - d * d, 0.5 * to_right * to_right},
                {-to_left, -2.0 * d, to_right},
                xi};
    }
};

/// Hat functions: for tests. Points on a node belong to the cell above it, except at the far wall.
class LinearKernel {
  public:
    Stencil operator()(double xi, const WallRows& walls) const {
        const auto nearest = static_cast<std::int32_t>(xi + 0.5);
        const double d = xi - nearest;
        if (d >= 0.0 && nearest != walls.high) {
            return {nearest - 1, {0.0, 1.0 - d, d}, {0.0, -1.0, 1.0}, xi};
        }
        return {nearest - 1, {-d, 1.0 + d, 0.0}, {-1.0, 1.0, 0.0}, xi};
    }
};

}  // namespace breach::mpm
