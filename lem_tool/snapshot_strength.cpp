#include "lem_tool/snapshot_strength.hpp"

#include <algorithm>
#include <cmath>

#include "core/exchange/excess_pressure.hpp"

namespace breach::lem {

using geometry::Vec2;

SnapshotStrength::SnapshotStrength(const exchange::MeshSnapshot& mesh,
                                   const liquefied::SoilMap& soils)
    : gauss_(mesh.gauss_positions), closed_(mesh.regions.size(), false) {
    const std::vector<double> excess = exchange::nodal_excess_pressure(mesh);
    Vec2 low = mesh.position_0.front(), high = low;
    for (std::size_t e = 0; e < mesh.quads.size(); ++e) {
        elements_.push_back(liquefied::undeformed_corners(mesh, e));
        low = low.cwiseMin(elements_.back().rowwise().minCoeff());
        high = high.cwiseMax(elements_.back().rowwise().maxCoeff());
        for (const Vec2& xi : gauss_) {
            const auto strength = soils.limit_strength_at(e, xi);
            if (!strength) closed_[mesh.region_of_element[e]] = true;
            const bool keeps = !excess.empty() && soils.soils()[soils.at(e, xi)].stress ==
                                                      exchange::StressMeasure::effective;
            const double u = keeps ? liquefied::corner_values(excess, mesh.quads[e])
                                         .dot(geometry::shape_functions(xi))
                                   : 0.0;
            places_.push_back({strength ? strength->c : 0.0, strength ? strength->tan_phi : 0.0,
                               std::max(u, 0.0)});
        }
    }
    origin_ = low;
    const Vec2 size = high - low;
    cell_ = std::sqrt(size.prod() / static_cast<double>(elements_.size()));
    columns_ = static_cast<std::int64_t>(size.x() / cell_) + 1;
    rows_ = static_cast<std::int64_t>(size.y() / cell_) + 1;
    cells_.resize(static_cast<std::size_t>(columns_ * rows_));
    for (std::size_t e = 0; e < elements_.size(); ++e) {
        const Vec2 from = (elements_[e].rowwise().minCoeff() - origin_) / cell_;
        const Vec2 to = (elements_[e].rowwise().maxCoeff() - origin_) / cell_;
        for (auto j = static_cast<std::int64_t>(from.y()); j <= std::int64_t(to.y()); ++j)
            for (auto i = static_cast<std::int64_t>(from.x()); i <= std::int64_t(to.x()); ++i)
                cells_[static_cast<std::size_t>(j * columns_ + i)].push_back(
                    static_cast<std::uint32_t>(e));
    }
}

const SnapshotStrength::Place* SnapshotStrength::at(const Vec2& place) const {
    const Vec2 cell = (place - origin_) / cell_;
    const auto i = static_cast<std::int64_t>(std::floor(cell.x()));
    const auto j = static_cast<std::int64_t>(std::floor(cell.y()));
    if (i < 0 || j < 0 || i >= columns_ || j >= rows_) return nullptr;
    for (const std::uint32_t e : cells_[static_cast<std::size_t>(j * columns_ + i)]) {
        const geometry::Corners& x = elements_[e];
        if (place.x() < x.row(0).minCoeff() || place.x() > x.row(0).maxCoeff() ||
            place.y() < x.row(1).minCoeff() || place.y() > x.row(1).maxCoeff())
            continue;
        const auto xi = geometry::natural_coordinates(x, place);
        if (!xi) continue;
        return &places_[e * gauss_.size() + liquefied::nearest_gauss(gauss_, *xi)];
    }
    return nullptr;
}

}  // namespace breach::lem
