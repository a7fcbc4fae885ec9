#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <sstream>

#include "fem_solver/mesh/mesh.hpp"

namespace breach::fem {
namespace {

double shortest_edge(const std::vector<Mesh>& parts) {
    double shortest = std::numeric_limits<double>::infinity();
    for (const Mesh& part : parts) shortest = std::min(shortest, quality_of(part).shortest_edge);
    return shortest;
}

/// Index of the first node within `tolerance` of each node (itself when there is none before it),
/// by a sweep over x.
std::vector<std::int32_t> first_coincident(const std::vector<Vec2>& nodes, double tolerance) {
    std::vector<std::int32_t> order(nodes.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
        return std::pair(nodes[a].x(), a) < std::pair(nodes[b].x(), b);
    });
    std::vector<std::int32_t> first(nodes.size());
    std::iota(first.begin(), first.end(), 0);
    for (std::size_t k = 0; k < order.size(); ++k) {
        const std::int32_t i = order[k];
        for (std::size_t l = k; l-- > 0;) {
            const std::int32_t j = order[l];
            if (nodes[i].x() - nodes[j].x() > tolerance) break;
            if ((nodes[i] - nodes[j]).norm() > tolerance) continue;
            const std::int32_t root = std::min(first[i], first[j]);
            first[i] = root;
            first[j] = root;
        }
    }
    return first;
}

struct BorderEdge {
    std::int32_t a, b;
    std::int32_t region;
};

/// Edges that belong to one element only.
std::vector<BorderEdge> border_of(const Mesh& mesh) {
    std::map<std::pair<std::int32_t, std::int32_t>, std::pair<int, std::int32_t>> uses;
    for (std::size_t e = 0; e < mesh.quads.size(); ++e) {
        for (std::size_t k = 0; k < 4; ++k) {
            const auto [low, high] = std::minmax(mesh.quads[e][k], mesh.quads[e][(k + 1) % 4]);
            auto& use = uses[{low, high}];
            ++use.first;
            use.second = mesh.region_of_element[e];
        }
    }
    std::vector<BorderEdge> border;
    for (const auto& [edge, use] : uses) {
        if (use.first == 1) border.push_back({edge.first, edge.second, use.second});
    }
    return border;
}

std::string text_of(const Vec2& x) {
    std::ostringstream out;
    out << "(" << x.x() << ", " << x.y() << ")";
    return out.str();
}

/// A node of one region that lies on, or almost on, a border edge of another without being one of
/// its ends.
std::vector<fault::Fault> misfits(const Mesh& mesh, const scene::Section& section,
                                  double tolerance) {
    constexpr double gap_share = 0.05;  // of the edge: nearer than this was meant to touch
    const std::vector<BorderEdge> border = border_of(mesh);
    std::map<std::int32_t, std::int32_t> region_of_node;
    for (const BorderEdge& edge : border) {
        region_of_node.emplace(edge.a, edge.region);
        region_of_node.emplace(edge.b, edge.region);
    }
    std::vector<fault::Fault> faults;
    std::map<std::pair<std::int32_t, std::int32_t>, int> reported;
    for (const BorderEdge& edge : border) {
        const Vec2 A = mesh.nodes[edge.a], B = mesh.nodes[edge.b];
        const double near = gap_share * (B - A).norm();
        for (const auto& [node, region] : region_of_node) {
            if (region == edge.region || node == edge.a || node == edge.b) continue;
            const Vec2& X = mesh.nodes[node];
            if (X.x() < std::min(A.x(), B.x()) - near || X.x() > std::max(A.x(), B.x()) + near)
                continue;
            const double distance = scene::distance_to_segment(X, A, B);
            if (distance > near) continue;
            if (reported[std::minmax(region, edge.region)]++ > 0) continue;
            const std::string kind = distance <= tolerance ? "hanging node" : "gap";
            faults.push_back(
                {"/section/regions/" + std::to_string(region),
                 kind + " between regions '" + section.regions[region].name + "' and '" +
                     section.regions[edge.region].name + "': node " + text_of(X) +
                     " lies beside the edge " + text_of(A) + " - " + text_of(B),
                 "give both regions the same vertices and divisions on their shared side"});
        }
    }
    return faults;
}

}  // namespace

Mesh join(const std::vector<Mesh>& parts, const scene::Section& section) {
    const double tolerance = 1e-6 * shortest_edge(parts);
    Mesh all;
    for (const Mesh& part : parts) {
        const auto shift = static_cast<std::int32_t>(all.nodes.size());
        all.nodes.insert(all.nodes.end(), part.nodes.begin(), part.nodes.end());
        for (Quad quad : part.quads) {
            for (std::int32_t& node : quad) node += shift;
            all.quads.push_back(quad);
        }
        all.region_of_element.insert(all.region_of_element.end(), part.region_of_element.begin(),
                                     part.region_of_element.end());
    }
    const std::vector<std::int32_t> first = first_coincident(all.nodes, tolerance);
    std::vector<std::int32_t> number(all.nodes.size(), -1);
    std::vector<Vec2> kept;
    for (std::size_t i = 0; i < all.nodes.size(); ++i) {
        const std::int32_t root = first[first[i]];
        if (number[root] < 0) {
            number[root] = static_cast<std::int32_t>(kept.size());
            kept.push_back(all.nodes[root]);
        }
        number[i] = number[root];
    }
    for (Quad& quad : all.quads) {
        for (std::int32_t& node : quad) node = number[node];
    }
    all.nodes = std::move(kept);
    if (auto faults = misfits(all, section, tolerance); !faults.empty()) {
        throw fault::BadInput("scene", std::move(faults));
    }
    return all;
}

}  // namespace breach::fem
