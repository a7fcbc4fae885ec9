#include "transfer_tool/grid_force.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/grid/kernel.hpp"
#include "core/scene/beds.hpp"
#include "transfer_tool/soils.hpp"

namespace breach::transfer {
namespace {

struct Node {
    Vec2 force = Vec2::Zero();
    Vec2 inertia = Vec2::Zero();
    double mass = 0.0;
    std::vector<double> mass_of_soil;
};

/// A map of nodes instead of the MPM's grid: one pass, and the transfer includes no other phase.
class GridOnce {
  public:
    explicit GridOnce(const scene::Scene& scene)
        : mpm_(scene::mpm_of(scene)),
          gravity_(scene.gravity),
          soils_(scene::soils_of(scene).size()) {
        columns_ = std::lround((mpm_.domain_x[1] - mpm_.domain_x[0]) / mpm_.cell_size);
        for (const scene::Soil& soil : scene::soils_of(scene)) {
            walls_of_soil_.push_back({.low = 0});
            if (const auto rows = scene::rows_below_bed(scene, soil.material))
                walls_of_soil_.back().high = *rows;
        }
    }

    void add(const Points& points, const std::vector<Vec2>& still_gradient) {
        const grid::GimpKernel kernel(mpm_.gimp_half_size);
        for (std::size_t p = 0; p < points.state.size(); ++p)
            add(points, p, kernel,
                still_gradient.empty() ? Vec2(0.0, 0.0)
                                       : Vec2(-points.state.volume[p] * still_gradient[p]));
    }

    std::vector<GridForce> sums() const {
        std::vector<GridForce> sums(soils_);
        for (const auto& [key, node] : nodes_) {
            if (node.mass <= 0.0) continue;
            const Vec2 free = freedom(key);
            for (std::size_t s = 0; s < soils_; ++s) {
                // The norm of the whole node's force is shared: forces of soils that balance one
                // another at a border are no imbalance.
                const double part = node.mass_of_soil[s] / node.mass;
                sums[s].force += part * node.force.cwiseProduct(free).norm();
                sums[s].inertia += part * node.inertia.cwiseProduct(free).norm();
                sums[s].weight += node.mass_of_soil[s] * gravity_;
            }
        }
        return sums;
    }

  private:
    // One key per node, ordered by column, which fixes the order of the sums over nodes.
    static constexpr long stride = 1L << 31;

    void add(const Points& points, std::size_t p, const grid::GimpKernel& kernel,
             const Vec2& push) {
        const exchange::ParticleState& s = points.state;
        const double h = mpm_.cell_size;
        const auto x = kernel((s.position[p].x() - mpm_.domain_x[0]) / h,
                              {.low = 0, .high = static_cast<std::int32_t>(columns_)});
        const auto y =
            kernel((s.position[p].y() - mpm_.floor.level) / h, walls_of_soil_[s.region[p]]);
        const mechanics::Voigt& sigma = s.stress[p];
        // 0 for total stress, which contains u already.
        const double u = s.pressure_beside(p);
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) {
                const double m = s.mass[p] * x.N[i] * y.N[j];
                const Vec2 dN = Vec2(x.dN[i] * y.N[j], x.N[i] * y.dN[j]) / h;
                Node& node = nodes_[(std::lround(x.first) + i) * stride + std::lround(y.first) + j];
                node.mass_of_soil.resize(soils_);
                node.mass += m;
                node.mass_of_soil[s.region[p]] += m;
                node.inertia += m * points.acceleration[p];
                node.force.x() -= s.volume[p] * ((sigma[0] - u) * dN.x() + sigma[3] * dN.y());
                node.force.y() -= s.volume[p] * (sigma[3] * dN.x() + (sigma[1] - u) * dN.y());
                node.force.y() -= m * gravity_;
                node.force += x.N[i] * y.N[j] * push;
            }
    }

    /// 1 in the free directions of a node, else 0. Floor and terrain hold both: friction is left to
    /// the MPM.
    Vec2 freedom(long key) const {
        // Rounded, not truncated: rows below the floor are negative.
        const long column = std::lround(static_cast<double>(key) / static_cast<double>(stride));
        const long row = key - column * stride;
        if (row <= 0) return Vec2::Zero();
        const double h = mpm_.cell_size;
        const double x = mpm_.domain_x[0] + h * static_cast<double>(column);
        const double y = mpm_.floor.level + h * static_cast<double>(row);
        if (!mpm_.terrain.empty() && y < geometry::level_at(mpm_.terrain, x) + h)
            return Vec2::Zero();
        const bool walled = (column <= 0 && mpm_.left != scene::Wall::open) ||
                            (column >= columns_ && mpm_.right != scene::Wall::open);
        const bool fixed = (column <= 0 && mpm_.left == scene::Wall::fixed) ||
                           (column >= columns_ && mpm_.right == scene::Wall::fixed);
        return {walled ? 0.0 : 1.0, fixed ? 0.0 : 1.0};
    }

    const scene::Mpm& mpm_;
    double gravity_;
    std::size_t soils_;
    std::vector<grid::WallRows> walls_of_soil_;  ///< vertical, from the floor's row
    long columns_ = 0;
    std::map<long, Node> nodes_;
};

}  // namespace

std::vector<GridForce> grid_force(const scene::Scene& scene, const Points& points,
                                  const std::vector<Vec2>& still_gradient) {
    GridOnce once(scene);
    once.add(points, still_gradient);
    return once.sums();
}

}  // namespace breach::transfer
