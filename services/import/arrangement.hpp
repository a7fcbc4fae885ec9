// Overlays chains of points: merges near vertices, bends edges through near vertices, and gives
// crossing edges a common node. The result divides the plane into faces. Independent of soils.
#pragma once

#include <utility>
#include <vector>

#include "core/geometry/polygon.hpp"

namespace breach::importing {

using geometry::Polygon;
using mechanics::Vec2;

struct Chain {
    std::vector<Vec2> points;
    bool closed;
};

/// A vertex that was moved to a node, or an edge that was bent through one.
struct Meeting {
    std::size_t chain;  ///< whose vertex or edge
    std::size_t with;   ///< chain of the other node
    Vec2 at;            ///< the node [m]
    Vec2 was;           ///< the vertex, or its foot on the edge [m]
    bool on_edge;
};

struct Snapped {
    std::vector<Vec2> nodes;                       ///< farther than the tolerance from each other
    std::vector<std::vector<std::size_t>> chains;  ///< nodes along each; closed: first not repeated
    std::vector<Meeting> meetings;
    bool settled;  ///< no edges cross, none is within the tolerance of others' nodes
};

/// The vertex drawn first stays; others within `tolerance` [m] move to it.
Snapped snapped(const std::vector<Chain>& chains, double tolerance);

using Edge = std::pair<std::size_t, std::size_t>;  ///< nodes, the lower one first
Edge edge_of(std::size_t a, std::size_t b);

/// Edges of one chain, each once.
std::vector<Edge> edges_of(const Snapped& snapped, std::size_t chain, bool closed);

struct Face {
    std::vector<std::size_t> ring;  ///< nodes, counter-clockwise; twice along an inner edge
    Vec2 inside;                    ///< a place well inside
    double width;                   ///< diameter of the largest circle found around `inside` [m]
    double area;                    ///< [m2]
};

/// Bounded faces; `edges`: each once. Does not detect parts inside faces of other parts.
std::vector<Face> faces_of(const std::vector<Vec2>& nodes, const std::vector<Edge>& edges);

/// Rings around the union of faces, split at nodes where it touches itself: outer rings
/// counter-clockwise, holes clockwise.
std::vector<std::vector<std::size_t>> union_of(const std::vector<Vec2>& nodes,
                                               const std::vector<const Face*>& faces);

Polygon polygon_of(const std::vector<Vec2>& nodes, const std::vector<std::size_t>& ring);

}  // namespace breach::importing
