#include "services/report/figures/mesh_figures.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <utility>

namespace breach::report {

using exchange::MeshSnapshot;

namespace {

mechanics::Vec2 deformed(const MeshSnapshot& mesh, std::int32_t node) {
    const auto i = static_cast<std::size_t>(node);
    return mesh.position_0[i] + mesh.displacement[i];
}

/// The elements at an edge: one on the outside, two inside.
using Sides = std::vector<std::size_t>;
std::map<std::pair<std::int32_t, std::int32_t>, Sides> sides_of(const MeshSnapshot& mesh) {
    std::map<std::pair<std::int32_t, std::int32_t>, Sides> sides;
    for (std::size_t e = 0; e < mesh.quads.size(); ++e) {
        for (std::size_t k = 0; k < 4; ++k) {
            const auto [a, b] = std::minmax(mesh.quads[e][k], mesh.quads[e][(k + 1) % 4]);
            sides[{a, b}].push_back(e);
        }
    }
    return sides;
}

template <class Wanted>
Series segments(const MeshSnapshot& mesh, const std::string& name, const Wanted& wanted) {
    Series s{name, {}, {}, Style::segments};
    for (const auto& [edge, elements] : sides_of(mesh)) {
        if (!wanted(elements)) continue;
        for (const std::int32_t node : {edge.first, edge.second}) {
            const mechanics::Vec2 x = deformed(mesh, node);
            s.x.push_back(x.x());
            s.y.push_back(x.y());
        }
    }
    return s;
}

}  // namespace

std::vector<double> element_epsilon_q(const MeshSnapshot& mesh) {
    const auto points = static_cast<std::size_t>(mesh.gauss_per_element);
    std::vector<double> average(mesh.quads.size(), 0.0);
    for (std::size_t p = 0; p < mesh.epsilon_q.size(); ++p) {
        average[p / points] += 100.0 * mesh.epsilon_q[p] / static_cast<double>(points);
    }
    return average;
}

std::vector<double> element_r_u(const MeshSnapshot& mesh, std::span<const double> excess) {
    if (excess.empty() || mesh.sigma_v0.empty()) return {};
    std::vector<double> average;
    for (const auto& quad : mesh.quads) {
        double rise = 0.0;  // values that alternate between corners cancel
        double sigma = 0.0;
        for (const std::int32_t node : quad) {
            const auto i = static_cast<std::size_t>(node);
            rise += excess[i];
            sigma += mesh.sigma_v0[i];
        }
        average.push_back(sigma > 0.0 ? rise / sigma : 0.0);
    }
    return average;
}

std::vector<double> element_r_u(const MeshSnapshot& mesh) {
    if (mesh.pore_pressure_0.empty()) return {};
    std::vector<double> excess = mesh.pore_pressure;
    std::ranges::transform(excess, mesh.pore_pressure_0, excess.begin(), std::minus());
    return element_r_u(mesh, excess);
}

Field on_deformed_mesh(const MeshSnapshot& mesh, std::vector<double> value,
                       const std::string& label, const Range& range) {
    Field field{label, 4, {}, {}, std::move(value), range};
    for (const auto& quad : mesh.quads) {
        for (const std::int32_t node : quad) {
            const mechanics::Vec2 x = deformed(mesh, node);
            field.x.push_back(x.x());
            field.y.push_back(x.y());
        }
    }
    return field;
}

Series edges_of(const MeshSnapshot& mesh) {
    return segments(mesh, "mesh", [](const Sides&) { return true; });
}

Series borders_of(const MeshSnapshot& mesh) {
    return segments(mesh, "borders of regions", [&](const Sides& elements) {
        return elements.size() == 1 ||
               mesh.region_of_element[elements[0]] != mesh.region_of_element[elements[1]];
    });
}

Range colour_range(std::vector<double> values) {
    if (values.empty()) return {0.0, 1.0};
    const std::size_t rank = (values.size() - 1) * 99 / 100;
    std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(rank));
    const double high = values[rank];
    if (high <= 0.0) return {0.0, 1.0};
    const double power = std::pow(10.0, std::floor(std::log10(high)));
    for (const double fold : {1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0}) {
        if (high <= fold * power) return {0.0, fold * power};
    }
    return {0.0, 10.0 * power};
}

}  // namespace breach::report
