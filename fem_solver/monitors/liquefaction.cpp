#include "fem_solver/monitors/liquefaction.hpp"

#include <algorithm>

namespace breach::fem {

std::vector<double> pore_pressure_ratio(std::span<const double> excess,
                                        std::span<const double> sigma_v0, double least_stress) {
    std::vector<double> r_u(excess.size(), 0.0);
    for (std::size_t i = 0; i < excess.size(); ++i) {
        // Under a small stress a small excess is a large ratio: the ground would always count as
        // liquefied.
        if (sigma_v0[i] >= least_stress) r_u[i] = excess[i] / sigma_v0[i];
    }
    return r_u;
}

std::vector<std::int32_t> nodes_in(const Mesh& mesh, const LiquefactionWindow& window) {
    std::vector<std::int32_t> nodes;
    for (std::size_t e = 0; e < mesh.quads.size(); ++e) {
        const auto region = static_cast<std::size_t>(mesh.region_of_element[e]);
        if (std::ranges::find(window.regions, region) == window.regions.end()) continue;
        for (const std::int32_t node : mesh.quads[e]) {
            const double x = mesh.nodes[node].x();
            if (x >= window.x[0] && x <= window.x[1]) nodes.push_back(node);
        }
    }
    std::ranges::sort(nodes);
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    return nodes;
}

double liquefaction_depth(const Mesh& mesh, std::span<const std::int32_t> nodes,
                          std::span<const double> r_u, const LiquefactionWindow& window) {
    double depth = 0.0;
    for (const std::int32_t node : nodes) {
        if (r_u[node] <= window.threshold) continue;
        depth = std::max(depth, window.level - mesh.nodes[node].y());
    }
    return depth;
}

}  // namespace breach::fem
