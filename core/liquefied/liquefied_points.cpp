#include "core/liquefied/liquefied_points.hpp"

#include "core/geometry/polyline.hpp"
#include "core/liquefied/elements.hpp"

namespace breach::liquefied {

using mechanics::Vec2;

bool LiquefiedPoints::holds(std::size_t element, const Vec2& xi, const Vec2& place) const {
    if (!water_table_.empty() && place.y() >= geometry::level_at(water_table_, place.x()))
        return false;
    const auto& gauss = mesh_->gauss_positions;
    const std::size_t p = element * gauss.size() + nearest_gauss(gauss, xi);
    return mesh_->r_u_max[p] >= r_u_ ||
           (shear_strain_ && mesh_->shear_strain_max[p] >= *shear_strain_);
}

}  // namespace breach::liquefied
