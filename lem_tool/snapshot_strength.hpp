// Strength of a FEM's snapshot at every place of the section, instead of one strength per region.
// make_model's soils get it in after_shaking.cpp; slice_maker.cpp asks it for each base.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/geometry/quad.hpp"
#include "core/liquefied/soil_map.hpp"

namespace breach::lem {

class SnapshotStrength {
  public:
    /// Of one Gauss point.
    struct Place {
        double c;        ///< [Pa]
        double tan_phi;  ///< [-]
        /// pore pressure above that before the shaking, where the runout keeps it: in soil whose
        /// stress is effective; not below zero [Pa]
        double excess;
    };

    /// Copies all that it needs of both.
    SnapshotStrength(const exchange::MeshSnapshot& mesh, const liquefied::SoilMap& soils);

    /// Of the nearest Gauss point of the element there, as points decide on liquefaction; null:
    /// outside the undeformed mesh.
    const Place* at(const geometry::Vec2& place) const;
    /// [regions of the mesh] whether a part of it cannot fail.
    const std::vector<bool>& closed() const { return closed_; }

  private:
    std::vector<geometry::Corners> elements_;  ///< undeformed
    std::vector<geometry::Vec2> gauss_;        ///< natural coordinates
    std::vector<Place> places_;                ///< [elements * gauss]
    std::vector<bool> closed_;
    // Elements by the square cells of a raster that their boxes touch.
    geometry::Vec2 origin_{0.0, 0.0};
    double cell_ = 1.0;
    std::int64_t columns_ = 0, rows_ = 0;
    std::vector<std::vector<std::uint32_t>> cells_;  ///< row by row
};

}  // namespace breach::lem
