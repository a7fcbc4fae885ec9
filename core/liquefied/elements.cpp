#include "core/liquefied/elements.hpp"

#include <algorithm>
#include <utility>

namespace breach::liquefied {

using exchange::MeshSnapshot;

Corners corner_values(const std::vector<Vec2>& field, const std::array<std::int32_t, 4>& quad) {
    Corners values;
    for (int i = 0; i < 4; ++i) values.col(i) = field[quad[i]];
    return values;
}

Eigen::Vector4d corner_values(const std::vector<double>& field,
                              const std::array<std::int32_t, 4>& quad) {
    return {field[quad[0]], field[quad[1]], field[quad[2]], field[quad[3]]};
}

std::size_t nearest_gauss(const std::vector<Vec2>& gauss_positions, const Vec2& xi) {
    const auto nearest = std::ranges::min_element(
        gauss_positions, {}, [&](const Vec2& each) { return (each - xi).squaredNorm(); });
    return static_cast<std::size_t>(nearest - gauss_positions.begin());
}

Corners undeformed_corners(const MeshSnapshot& mesh, std::size_t element) {
    return corner_values(mesh.position_0, mesh.quads[element]);
}

double displacement_of_base(const MeshSnapshot& mesh) {
    const auto lower = [](const Vec2& a, const Vec2& b) {
        return std::pair(a.y(), a.x()) < std::pair(b.y(), b.x());
    };
    const auto lowest = std::ranges::min_element(mesh.position_0, lower);
    return mesh.displacement[lowest - mesh.position_0.begin()].x();
}

double pore_pressure_ratio(double d_u, double sigma_v0) {
    return sigma_v0 > 0.0 ? d_u / sigma_v0 : 0.0;
}

}  // namespace breach::liquefied
