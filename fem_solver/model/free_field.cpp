#include "fem_solver/model/free_field.hpp"

#include <algorithm>
#include <map>

namespace breach::fem {
namespace {

enum class Side { left, right };

/// Nodes with the smallest or largest x, from below.
std::vector<std::int32_t> side_nodes(const Mesh& mesh, const Body& body, Side side,
                                     double tolerance) {
    const double sign = side == Side::left ? 1.0 : -1.0;
    double outermost = mesh.nodes.front().x() * sign;
    for (std::size_t i = 0; i < body.nodes; ++i) {
        outermost = std::min(outermost, sign * mesh.nodes[i].x());
    }
    std::vector<std::int32_t> nodes;
    for (std::size_t i = 0; i < body.nodes; ++i) {
        if (sign * mesh.nodes[i].x() <= outermost + tolerance) {
            nodes.push_back(static_cast<std::int32_t>(i));
        }
    }
    std::ranges::sort(nodes, {}, [&](std::int32_t i) { return mesh.nodes[i].y(); });
    return nodes;
}

/// Region of the element at each edge, by its two nodes in ascending order.
std::map<std::array<std::int32_t, 2>, std::int32_t> regions_of_edges(const Mesh& mesh,
                                                                     const Body& body) {
    std::map<std::array<std::int32_t, 2>, std::int32_t> regions;
    for (std::size_t e = 0; e < body.elements; ++e) {
        for (std::size_t k = 0; k < 4; ++k) {
            const std::int32_t a = mesh.quads[e][k], b = mesh.quads[e][(k + 1) % 4];
            regions[{std::min(a, b), std::max(a, b)}] = mesh.region_of_element[e];
        }
    }
    return regions;
}

void add_column(const scene::FreeField& field, const Body& body, Side side, double tolerance,
                Mesh& mesh, FreeFieldColumns& columns) {
    const auto edge = side_nodes(mesh, body, side, tolerance);
    // Each column element has the soil of its neighbour in the section.
    const auto regions = regions_of_edges(mesh, body);
    const auto refuse = [side] {
        throw fault::BadInput("scene",
                              {{"/fem/free_field",
                                std::string("the ") + (side == Side::left ? "left" : "right") +
                                    " side of the mesh is not one vertical line of element edges",
                                "end the section in a vertical side, or leave this column out"}});
    };
    if (edge.size() < 2) refuse();  // inclined
    const Vec2 outwards(side == Side::left ? -field.width : field.width, 0.0);
    const auto first = static_cast<std::int32_t>(mesh.nodes.size());
    for (const std::int32_t node : edge) {
        const auto inner = static_cast<std::int32_t>(mesh.nodes.size());
        const Vec2 x = mesh.nodes[node];
        // At the place of the edge's node, but with its own pressure: the column's excess pressure
        // is that of level ground.
        mesh.nodes.push_back(x);
        mesh.nodes.push_back(x + outwards);
        columns.ties.push_back({node, inner});
        columns.ties.push_back({node, inner + 1});
        columns.pressure_ties.push_back({inner, inner + 1});
        columns.inner.push_back(inner);
    }
    for (std::size_t j = 0; j + 1 < edge.size(); ++j) {
        const auto region =
            regions.find({std::min(edge[j], edge[j + 1]), std::max(edge[j], edge[j + 1])});
        if (region == regions.end()) refuse();
        const std::int32_t low = first + 2 * static_cast<std::int32_t>(j);
        const std::int32_t inner = low, outer = low + 1, inner_up = low + 2, outer_up = low + 3;
        mesh.quads.push_back(side == Side::left ? Quad{outer, inner, inner_up, outer_up}
                                                : Quad{inner, outer, outer_up, inner_up});
        mesh.region_of_element.push_back(region->second);
    }
}

}  // namespace

FreeFieldColumns add_free_field(const scene::FreeField& field, Mesh& mesh) {
    using scene::FreeFieldSides;
    const Body body{mesh.nodes.size(), mesh.quads.size()};
    const double tolerance = 1e-6 * quality_of(mesh).shortest_edge;
    FreeFieldColumns columns;
    if (field.sides != FreeFieldSides::right) {
        add_column(field, body, Side::left, tolerance, mesh, columns);
    }
    if (field.sides != FreeFieldSides::left) {
        add_column(field, body, Side::right, tolerance, mesh, columns);
    }
    return columns;
}

}  // namespace breach::fem
