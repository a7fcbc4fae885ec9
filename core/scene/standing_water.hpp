// Still water in the runout: the pressure that the reservoir of /mpm/water and the pores' steady
// water have at every place. The transfer adds it to the stress of the points, and the MPM applies
// its gradient to them; both read it from here, so that a state at rest stays at rest. The pressure
// belongs to places and not to soil: soil that slides into the reservoir gets the pressure there.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>

#include "core/mechanics/nodal_field.hpp"
#include "core/scene/scene.hpp"

namespace breach::scene {

/// The pool's highest level between the ends of the MPM's grid [m].
double highest_level(const Pool& pool, double from, double to);

/// Bilinear between the nodes of the MPM's grid, its ghost row included, so that sum V p is the
/// potential of the force -V grad p. The nodes keep values below zero above the water, and only
/// what is read is cut off there: level water is exact.
class StandingWater {
  public:
    /// None.
    StandingWater() = default;
    /// Of /mpm/water, which may be missing. `steady` is the FEM's pore pressure before the shaking
    /// [Pa] and holds within its mesh; without it the line does, hydrostatic below it.
    explicit StandingWater(const Scene& scene, const mechanics::NodalField& steady = {});

    bool is_there() const { return !nodes_.empty(); }
    double pressure(const Vec2& place) const { return std::max(at(place).value, 0.0); }  ///< [Pa]
    Vec2 gradient(const Vec2& place) const {                                             ///< [Pa/m]
        const Read read = at(place);
        return read.value > 0.0 ? read.slope : Vec2(0.0, 0.0);
    }
    /// Pressure at the nodes, column by column, for checkpoints [Pa].
    const std::vector<double>& nodes() const { return nodes_; }
    void set_nodes(std::vector<double> nodes) { nodes_ = std::move(nodes); }

  private:
    struct Read {
        double value;
        Vec2 slope;
    };
    Read at(const Vec2& place) const {
        const double xi = (place.x() - origin_.x()) * per_h_,
                     eta = (place.y() - origin_.y()) * per_h_;
        const auto i = std::clamp<std::int64_t>(static_cast<std::int64_t>(xi), 0, columns_ - 2);
        const auto j = std::clamp<std::int64_t>(static_cast<std::int64_t>(eta), 0, rows_ - 2);
        const double* low = nodes_.data() + i * rows_ + j;
        const double* high = low + rows_;
        const double tx = xi - static_cast<double>(i), ty = eta - static_cast<double>(j);
        const double left = low[0] + ty * (low[1] - low[0]);
        const double right = high[0] + ty * (high[1] - high[0]);
        const double up = low[1] - low[0] + tx * (high[1] - high[0] - low[1] + low[0]);
        return {left + tx * (right - left), per_h_ * Vec2(right - left, up)};
    }

    Vec2 origin_{0.0, 0.0};
    double per_h_ = 0.0;
    std::int64_t columns_ = 0, rows_ = 0;
    std::vector<double> nodes_;
};

}  // namespace breach::scene
