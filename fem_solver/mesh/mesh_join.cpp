// Makes one mesh of the blocks' meshes. Blocks are meshed one by one, so only here it shows whether
// their common sides match. A gap or a hanging node would be a crack: the halves could part freely.
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

/// Index of the first node within `tolerance` of each node (possibly itself), by a sweep over x.
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
            // The first node of a group keeps its coordinates, whichever is found first.
            const std::int32_t root = std::min(first[i], first[j]);
            first[i] = root;
            first[j] = root;
        }
    }
    return first;
}

/// An edge of one element only, counter-clockwise around it.
struct MeshEdge {
    std::int32_t a, b;
    std::size_t element;
};

std::vector<MeshEdge> border_of(const Mesh& mesh) {
    std::map<std::pair<std::int32_t, std::int32_t>, std::vector<MeshEdge>> uses;
    for (std::size_t e = 0; e < mesh.quads.size(); ++e) {
        for (std::size_t k = 0; k < 4; ++k) {
            const std::int32_t a = mesh.quads[e][k], b = mesh.quads[e][(k + 1) % 4];
            uses[std::minmax(a, b)].push_back({a, b, e});
        }
    }
    std::vector<MeshEdge> border;
    for (const auto& [edge, use] : uses) {
        if (use.size() == 1) border.push_back(use.front());
    }
    return border;
}

Vec2 outwards(const Mesh& mesh, const MeshEdge& edge) {
    const Vec2 along = (mesh.nodes[edge.b] - mesh.nodes[edge.a]).normalized();
    return {along.y(), -along.x()};
}

std::string text_of(const Vec2& x) {
    std::ostringstream out;
    out << "(" << x.x() << ", " << x.y() << ")";
    return out.str();
}

/// Inside by at least the tolerance.
bool lies_inside(const Mesh& mesh, std::size_t element, const Vec2& x, double tolerance) {
    const Quad& quad = mesh.quads[element];
    for (std::size_t k = 0; k < 4; ++k) {
        const MeshEdge edge{quad[k], quad[(k + 1) % 4], element};
        if (outwards(mesh, edge).dot(x - mesh.nodes[edge.a]) > -tolerance) return false;
    }
    return true;
}

/// How a border node fails to match another region's border edge; null if there is no fault. Only
/// nodes that face the edge leave a gap: a layer thinner than its elements has other nodes nearby.
const char* misfit(const Mesh& mesh, const MeshEdge& edge, std::int32_t node,
                   const std::vector<Vec2>& outwards_of_node, double tolerance) {
    constexpr double gap_share = 0.05;  // over the edge length: nearer nodes should coincide
    constexpr double faces = -0.5;      // largest cosine between the normals
    const Vec2 &A = mesh.nodes[edge.a], &B = mesh.nodes[edge.b], &X = mesh.nodes[node];
    const double length = (B - A).norm(), along = (B - A).dot(X - A) / length;
    if (along < -tolerance || along > length + tolerance) return nullptr;
    const Vec2 out = outwards(mesh, edge);
    const double off = out.dot(X - A);
    if (std::abs(off) <= tolerance) return "hanging node";
    if (std::abs(off) > gap_share * length) return nullptr;
    if (off < 0.0) return lies_inside(mesh, edge.element, X, tolerance) ? "overlap" : nullptr;
    const auto facing = [&](const Vec2& other) { return out.dot(other) < faces; };
    return std::ranges::any_of(outwards_of_node, facing) ? "gap" : nullptr;
}

std::vector<fault::Fault> misfits(const Mesh& mesh, const scene::Section& section,
                                  double tolerance) {
    struct BorderNode {
        std::int32_t region;
        std::vector<Vec2> outwards;
    };
    const std::vector<MeshEdge> border = border_of(mesh);
    std::map<std::int32_t, BorderNode> nodes;
    for (const MeshEdge& edge : border) {
        for (const std::int32_t node : {edge.a, edge.b}) {
            const auto [at, first] = nodes.try_emplace(node);
            if (first) at->second.region = mesh.region_of_element[edge.element];
            at->second.outwards.push_back(outwards(mesh, edge));
        }
    }
    std::vector<fault::Fault> faults;
    std::map<std::pair<std::int32_t, std::int32_t>, int> reported;
    for (const MeshEdge& edge : border) {
        const std::int32_t own = mesh.region_of_element[edge.element];
        for (const auto& [node, of_node] : nodes) {
            if (of_node.region == own || node == edge.a || node == edge.b) continue;
            const char* kind = misfit(mesh, edge, node, of_node.outwards, tolerance);
            // One fault per pair of regions: a side that does not match has as many as it has
            // nodes.
            if (!kind || reported[std::minmax(of_node.region, own)]++ > 0) continue;
            faults.push_back(
                {"/section/regions/" + std::to_string(of_node.region),
                 std::string(kind) + " between regions '" + section.regions[of_node.region].name +
                     "' and '" + section.regions[own].name + "': node " +
                     text_of(mesh.nodes[node]) + " lies beside the edge " +
                     text_of(mesh.nodes[edge.a]) + " - " + text_of(mesh.nodes[edge.b]),
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
        // Twice: the first node of a group may itself have moved to an earlier one.
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
