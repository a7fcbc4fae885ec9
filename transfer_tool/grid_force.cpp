#include "transfer_tool/grid_force.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "transfer_tool/soils.hpp"

namespace breach::transfer {
namespace {

/// Weights of three neighbouring nodes in one direction, and their slopes [1/cell].
struct Stencil {
    long first;
    double N[3];
    double dN[3];
};

/// The hat function averaged over [xi - l, xi + l] (Bardenhagen & Kober 2004); a domain is clipped
/// at the node rows `low` and `high`. l -> 0 gives hats, l = 1/2 the quadratic B-spline.
Stencil gimp(double xi, double l, long low, long high) {
    const auto nearest = static_cast<long>(std::floor(xi + 0.5));
    const double d = xi - static_cast<double>(nearest);
    if (nearest == low && d < l) {
        const double reach = 0.5 * (d + l);
        return {nearest - 1, {0.0, 1.0 - reach, reach}, {0.0, -1.0, 1.0}};
    }
    if (nearest == high && -d < l) {
        const double reach = 0.5 * (l - d);
        return {nearest - 1, {reach, 1.0 - reach, 0.0}, {-1.0, 1.0, 0.0}};
    }
    const double e = std::clamp(d, -l, l);
    const double right = (l + e) * (l + e) / (4.0 * l) + std::max(d - l, 0.0);
    const double left = (l - e) * (l - e) / (4.0 * l) + std::max(-d - l, 0.0);
    const double d_right = (l + e) / (2.0 * l);
    const double d_left = -(l - e) / (2.0 * l);
    return {nearest - 1, {left, 1.0 - left - right, right}, {d_left, -d_left - d_right, d_right}};
}

double half_size(const scene::Mpm& mpm) {
    if (mpm.kernel == scene::Kernel::gimp) return mpm.gimp_half_size;
    return mpm.kernel == scene::Kernel::b_spline ? 0.5 : 1e-6;
}

struct Node {
    Vec2 force = Vec2::Zero();
    Vec2 inertia = Vec2::Zero();
    double mass = 0.0;
    std::vector<double> mass_of_soil;
};

class GridOnce {
  public:
    explicit GridOnce(const scene::Scene& scene)
        : mpm_(scene::mpm_of(scene)),
          gravity_(scene.gravity),
          l_(half_size(mpm_)),
          soils_(scene::soils_of(scene).size()) {
        columns_ = std::lround((mpm_.domain_x[1] - mpm_.domain_x[0]) / mpm_.cell_size);
    }

    void add(const Points& points, std::size_t p) {
        const exchange::ParticleState& s = points.state;
        const double h = mpm_.cell_size;
        const Stencil x = gimp((s.position[p].x() - mpm_.domain_x[0]) / h, l_, 0, columns_);
        const Stencil y = gimp((s.position[p].y() - mpm_.floor.level) / h, l_, 0, never);
        const mechanics::Voigt& sigma = s.stress[p];
        const bool effective =
            !s.stress_of_regions.empty() &&
            s.stress_of_regions[s.region[p]] == exchange::StressMeasure::effective;
        const double u = effective ? s.pore_pressure[p] : 0.0;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) {
                const double m = s.mass[p] * x.N[i] * y.N[j];
                const Vec2 dN = Vec2(x.dN[i] * y.N[j], x.N[i] * y.dN[j]) / h;
                Node& node = nodes_[(x.first + i) * stride + y.first + j];
                node.mass_of_soil.resize(soils_);
                node.mass += m;
                node.mass_of_soil[s.region[p]] += m;
                node.inertia += m * points.acceleration[p];
                node.force.x() -= s.volume[p] * ((sigma[0] - u) * dN.x() + sigma[3] * dN.y());
                node.force.y() -= s.volume[p] * (sigma[3] * dN.x() + (sigma[1] - u) * dN.y());
                node.force.y() -= m * gravity_;
            }
    }

    std::vector<GridForce> sums() const {
        std::vector<GridForce> sums(soils_);
        for (const auto& [key, node] : nodes_) {
            if (node.mass <= 0.0) continue;
            const Vec2 free = freedom(key);
            for (std::size_t s = 0; s < soils_; ++s) {
                const double part = node.mass_of_soil[s] / node.mass;
                sums[s].force += part * node.force.cwiseProduct(free).norm();
                sums[s].inertia += part * node.inertia.cwiseProduct(free).norm();
                sums[s].weight += node.mass_of_soil[s] * gravity_;
            }
        }
        return sums;
    }

  private:
    static constexpr long stride = 1L << 31;
    static constexpr long never = 1L << 30;

    /// 1 in the directions in which nothing holds the node. Floor and terrain hold in both: what
    /// friction can take is the MPM's to find.
    Vec2 freedom(long key) const {
        const auto column = static_cast<long>(
            std::floor(static_cast<double>(key + stride / 2) / static_cast<double>(stride)));
        const long row = key - column * stride;
        if (row <= 0) return Vec2::Zero();
        const double h = mpm_.cell_size;
        const double x = mpm_.domain_x[0] + h * static_cast<double>(column);
        const double y = mpm_.floor.level + h * static_cast<double>(row);
        if (!mpm_.terrain.empty() && y < level_at(mpm_.terrain, x) + h) return Vec2::Zero();
        const bool walled = (column <= 0 && mpm_.left != scene::Wall::open) ||
                            (column >= columns_ && mpm_.right != scene::Wall::open);
        const bool fixed = (column <= 0 && mpm_.left == scene::Wall::fixed) ||
                           (column >= columns_ && mpm_.right == scene::Wall::fixed);
        return {walled ? 0.0 : 1.0, fixed ? 0.0 : 1.0};
    }

    const scene::Mpm& mpm_;
    double gravity_;
    double l_;
    std::size_t soils_;
    long columns_ = 0;
    std::map<long, Node> nodes_;
};

}  // namespace

std::vector<GridForce> grid_force(const scene::Scene& scene, const Points& points) {
    GridOnce grid(scene);
    for (std::size_t p = 0; p < points.state.size(); ++p) grid.add(points, p);
    return grid.sums();
}

}  // namespace breach::transfer
