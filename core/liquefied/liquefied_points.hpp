// Liquefaction point by point, for sections in which layers between liquefied ones stand. SoilMap
// asks it for each new point; liquefied_zone.hpp is the rule by columns.
#pragma once

#include <optional>
#include <vector>

#include "core/exchange/mesh_snapshot.hpp"
#include "core/mechanics/tensor.hpp"

namespace breach::liquefied {

/// A place is liquefied if the nearest Gauss point of its element ever had at least this r_u or this
/// shear strain since the shaking began, and if it lies below the water table. On the undeformed
/// mesh.
class LiquefiedPoints {
  public:
    /// `mesh` must outlive it and have r_u_max. An empty water table is not known.
    LiquefiedPoints(const exchange::MeshSnapshot& mesh, double r_u,
                    std::optional<double> shear_strain, std::vector<mechanics::Vec2> water_table)
        : mesh_(&mesh),
          r_u_(r_u),
          shear_strain_(shear_strain),
          water_table_(std::move(water_table)) {}

    /// `xi`: natural coordinates in the element; `place`: the same undeformed [m].
    bool holds(std::size_t element, const mechanics::Vec2& xi, const mechanics::Vec2& place) const;

  private:
    const exchange::MeshSnapshot* mesh_;
    double r_u_;
    std::optional<double> shear_strain_;
    std::vector<mechanics::Vec2> water_table_;
};

}  // namespace breach::liquefied
