// How deep the ground has liquefied, column by column.
#pragma once

#include <map>
#include <vector>

#include "core/exchange/mesh_snapshot.hpp"
#include "core/mechanics/tensor.hpp"

namespace breach::transfer {

using mechanics::Vec2;

/// A node is liquefied where r_u = (u - u_0) / sigma'_v0 is above the threshold. It stands for the
/// column between the middles of its elements to the left and to the right; everything above the
/// deepest liquefied node of a column is liquefied. All on the undeformed mesh.
class LiquefiedZone {
  public:
    /// regions: [n_regions of the mesh] whether the region can liquefy. The mesh has sigma_v0.
    LiquefiedZone(const exchange::MeshSnapshot& mesh, const std::vector<char>& regions,
                  double threshold);

    /// Whether the place [m] lies in the zone.
    bool holds(const Vec2& place) const;
    std::size_t liquefied_nodes() const { return nodes_; }
    /// Lowest level reached anywhere [m]; nothing liquefied: +infinity.
    double deepest_level() const { return deepest_; }

    /// X where it begins -> level; +infinity: none
  private:
    std::map<double, double> level_from_;
    std::size_t nodes_ = 0;
    double deepest_;
};

}  // namespace breach::transfer
