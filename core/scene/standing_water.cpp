// Sets the nodal pressures once, when the body is made or the transfer begins; the loops only read
// them. First the line, hydrostatic below it; then, within its mesh, the FEM's steady pore
// pressure: a line drawn through a core presses too hard there.
#include "core/scene/standing_water.hpp"

#include <cmath>

#include "core/geometry/polyline.hpp"
#include "core/geometry/quad.hpp"

namespace breach::scene {

double highest_level(const Pool& pool, double from, double to) {
    double highest =
        std::max(geometry::level_at(pool.line, from), geometry::level_at(pool.line, to));
    for (const Vec2& point : pool.line)
        if (point.x() >= from && point.x() <= to) highest = std::max(highest, point.y());
    return highest;
}

StandingWater::StandingWater(const Scene& scene, const mechanics::NodalField& steady) {
    const Mpm& mpm = mpm_of(scene);
    if (!mpm.water) return;
    const double h = mpm.cell_size, gamma = mpm.water->density * scene.gravity;
    origin_ = {mpm.domain_x[0] - h, mpm.floor.level - h};
    per_h_ = 1.0 / h;
    columns_ = std::lround((mpm.domain_x[1] - mpm.domain_x[0]) * per_h_) + 3;
    rows_ = std::lround((mpm.domain_y[1] - mpm.floor.level) * per_h_) + 3;
    nodes_.resize(static_cast<std::size_t>(columns_ * rows_));
    const auto node = [&](std::int64_t i, std::int64_t j) -> double& {
        return nodes_[static_cast<std::size_t>(i * rows_ + j)];
    };
    const auto place = [&](std::int64_t i, std::int64_t j) {
        return Vec2(origin_ + h * Vec2(static_cast<double>(i), static_cast<double>(j)));
    };
    for (std::int64_t i = 0; i < columns_; ++i) {
        const double level = geometry::level_at(mpm.water->line, place(i, 0).x());
        for (std::int64_t j = 0; j < rows_; ++j) node(i, j) = gamma * (level - place(i, j).y());
    }
    if (!steady.any()) return;
    // Far below zero beside a wet mesh would push points out of the last cell of a dry face.
    for (double& each : nodes_) each = std::max(each, -gamma * h);
    for (const auto& quad : steady.quads) {
        geometry::Corners x;
        Eigen::Vector4d value;
        for (int k = 0; k < 4; ++k) {
            x.col(k) = steady.position[quad[k]];
            value[k] = steady.value[quad[k]];
        }
        const auto range = [&](int axis, std::int64_t count) {
            const double low = (x.row(axis).minCoeff() - origin_[axis]) * per_h_;
            const double high = (x.row(axis).maxCoeff() - origin_[axis]) * per_h_;
            return std::pair(
                std::max<std::int64_t>(std::lround(std::ceil(low - 1e-6)), 0),
                std::min<std::int64_t>(std::lround(std::floor(high + 1e-6)), count - 1));
        };
        const auto [left, right] = range(0, columns_);
        const auto [low, high] = range(1, rows_);
        for (std::int64_t i = left; i <= right; ++i)
            for (std::int64_t j = low; j <= high; ++j)
                if (const auto xi = geometry::natural_coordinates(x, place(i, j)))
                    node(i, j) = value.dot(geometry::shape_functions(*xi));
    }
}

}  // namespace breach::scene
