// Overlay of chains of points: near vertices are merged, near edges pass through them, edges that
// cross get a common node. The result divides the plane into faces. Knows no soils.
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

/// A vertex that was moved to a node, or an edge that was bent to one.
struct Meeting {
    std::size_t chain;  ///< whose vertex or edge
    std::size_t with;   ///< chain that the node belongs to
    Vec2 at;            ///< the node [m]
    Vec2 was;           ///< the vertex, or its foot on the edge [m]
    bool on_edge;
};

struct Snapped {
    std::vector<Vec2> nodes;                       ///< farther than the tolerance from each other
    std::vector<std::vector<std::size_t>> chains;  ///< nodes along each; closed: first not repeated
    std::vector<Meeting> meetings;
    bool settled;  ///< no edge is nearer to a foreign node than the tolerance, none cross
};

/// The vertex that was drawn first stays; others within `tolerance` [m] are moved to it.
Snapped snapped(const std::vector<Chain>& chains, double tolerance);

using Edge = std::pair<std::size_t, std::size_t>;  ///< nodes, the lower one first
Edge edge_of(std::size_t a, std::size_t b);

/// Edges of one chain, each once.
std::vector<Edge> edges_of(const Snapped& snapped, std::size_t chain, bool closed);

struct Face {
    std::vector<std::size_t> ring;  ///< nodes, counter-clockwise; an edge into it is passed twice
    Vec2 inside;                    ///< a place well inside
    double width;                   ///< of the largest circle found there [m]
    double area;                    ///< [m2]
};

/// Bounded faces; `edges` each once. Unconnected parts may lie undetected in each other's faces.
std::vector<Face> faces_of(const std::vector<Vec2>& nodes, const std::vector<Edge>& edges);

/// Rings that bound the union of faces, split at nodes where it touches itself: outer ones
/// counter-clockwise, holes clockwise.
std::vector<std::vector<std::size_t>> union_of(const std::vector<Vec2>& nodes,
                                               const std::vector<const Face*>& faces);

Polygon polygon_of(const std::vector<Vec2>& nodes, const std::vector<std::size_t>& ring);

}  // namespace breach::importing
