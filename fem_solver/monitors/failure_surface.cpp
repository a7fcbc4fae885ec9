#include "fem_solver/monitors/failure_surface.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>

namespace breach::fem {
namespace {

struct BorderEdge {
    std::int32_t to;
    std::size_t element;
};

/// Border edges by their first node, the body on their left.
std::map<std::int32_t, BorderEdge> border_of(const Mesh& mesh) {
    std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> edges;
    for (std::size_t e = 0; e < mesh.quads.size(); ++e) {
        for (std::size_t k = 0; k < 4; ++k) {
            edges[{mesh.quads[e][k], mesh.quads[e][(k + 1) % 4]}] = e;
        }
    }
    std::map<std::int32_t, BorderEdge> border;
    for (const auto& [edge, element] : edges) {
        if (!edges.contains({edge.second, edge.first})) {
            border[edge.first] = {edge.second, element};
        }
    }
    return border;
}

enum class Side { left, right };

/// Highest border node of the mesh's left or right side.
std::int32_t upper_corner(const Mesh& mesh, const std::map<std::int32_t, BorderEdge>& border,
                          Side side) {
    const double sign = side == Side::left ? 1.0 : -1.0;
    double outermost = std::numeric_limits<double>::infinity();
    for (const auto& [node, edge] : border) {
        outermost = std::min(outermost, sign * mesh.nodes[node].x());
    }
    const double near = 1e-6 * (1.0 + std::abs(outermost));
    std::int32_t best = -1;
    for (const auto& [node, edge] : border) {
        if (sign * mesh.nodes[node].x() > outermost + near) continue;
        if (best < 0 || mesh.nodes[node].y() > mesh.nodes[best].y()) best = node;
    }
    return best;
}

/// Elements above the threshold, joined where they share a node: the band of each, -1 outside.
std::vector<std::int32_t> bands_of(const Mesh& mesh, std::span<const double> epsilon_q,
                                   double threshold) {
    std::vector<std::int32_t> parent(mesh.quads.size());
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&](std::int32_t e) {
        while (parent[e] != e) e = parent[e] = parent[parent[e]];
        return e;
    };
    std::vector<std::int32_t> first_at_node(mesh.nodes.size(), -1);
    for (std::size_t e = 0; e < mesh.quads.size(); ++e) {
        if (epsilon_q[e] <= threshold) continue;
        for (const std::int32_t node : mesh.quads[e]) {
            if (first_at_node[node] < 0) first_at_node[node] = static_cast<std::int32_t>(e);
            const std::int32_t a = root(static_cast<std::int32_t>(e));
            const std::int32_t b = root(first_at_node[node]);
            parent[std::max(a, b)] = std::min(a, b);
        }
    }
    std::vector<std::int32_t> band(mesh.quads.size(), -1);
    for (std::size_t e = 0; e < mesh.quads.size(); ++e) {
        if (epsilon_q[e] > threshold) band[e] = root(static_cast<std::int32_t>(e));
    }
    return band;
}

}  // namespace

Ground ground_of(const Mesh& mesh) {
    const auto border = border_of(mesh);
    const std::int32_t last = upper_corner(mesh, border, Side::left);
    // The border runs counter-clockwise: along the ground from right to left.
    Ground ground;
    std::vector<double> length;
    for (std::int32_t node = upper_corner(mesh, border, Side::right); node != last;) {
        const BorderEdge& edge = border.at(node);
        ground.element.push_back(edge.element);
        length.push_back((mesh.nodes[edge.to] - mesh.nodes[node]).norm());
        node = edge.to;
    }
    std::ranges::reverse(ground.element);
    std::ranges::reverse(length);
    double along = 0.0;
    for (const double each : length) {
        ground.begin.push_back(along);
        along += each;
        ground.end.push_back(along);
    }
    return ground;
}

FailureSurfaces failure_surfaces_of(const Mesh& mesh, const Ground& ground,
                                    std::span<const double> epsilon_q, double threshold,
                                    double least_separation) {
    const std::vector<std::int32_t> band = bands_of(mesh, epsilon_q, threshold);
    std::map<std::int32_t, double> left_ground_at;  // end of a band's last contact so far [m]
    FailureSurfaces surfaces{0, std::vector<bool>(mesh.quads.size(), false)};
    std::vector<bool> is_surface(mesh.quads.size(), false);  // by band
    for (std::size_t i = 0; i < ground.element.size(); ++i) {
        const std::int32_t b = band[ground.element[i]];
        if (b < 0) continue;
        const auto met = left_ground_at.find(b);
        if (met != left_ground_at.end() && ground.begin[i] - met->second > least_separation) {
            ++surfaces.count;
            is_surface[b] = true;
        }
        left_ground_at[b] = ground.end[i];
    }
    for (std::size_t e = 0; e < band.size(); ++e) {
        surfaces.holds[e] = band[e] >= 0 && is_surface[band[e]];
    }
    return surfaces;
}

}  // namespace breach::fem
