// Two counts, as neither sees all surfaces: places where a band meets the ground (Exits), and
// bodies that bands cut off (CutOff), for surfaces that share their places. The larger one counts.
#include "fem_solver/monitors/failure_surface.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>

#include "core/geometry/polyline.hpp"

namespace breach::fem {
namespace {

struct BorderEdge {
    std::int32_t to;
    std::size_t element;
};

/// Elements by their edges, from first to second node, with the element on the left.
using Edges = std::map<std::pair<std::int32_t, std::int32_t>, std::size_t>;

Edges edges_of(const Mesh& mesh) {
    Edges edges;
    for (std::size_t e = 0; e < mesh.quads.size(); ++e) {
        for (std::size_t k = 0; k < 4; ++k) {
            edges[{mesh.quads[e][k], mesh.quads[e][(k + 1) % 4]}] = e;
        }
    }
    return edges;
}

/// Border edges by their first node, with the body on the left.
std::map<std::int32_t, BorderEdge> border_of(const Edges& edges) {
    std::map<std::int32_t, BorderEdge> border;
    for (const auto& [edge, element] : edges) {
        if (!edges.contains({edge.second, edge.first})) {
            border[edge.first] = {edge.second, element};
        }
    }
    return border;
}

/// Neighbours across each edge; the whole border as `edge`.
std::vector<std::array<std::int32_t, 4>> neighbours_of(const Mesh& mesh, const Edges& edges) {
    std::vector<std::array<std::int32_t, 4>> beside(mesh.quads.size());
    for (std::size_t e = 0; e < mesh.quads.size(); ++e) {
        for (std::size_t k = 0; k < 4; ++k) {
            const auto across = edges.find({mesh.quads[e][(k + 1) % 4], mesh.quads[e][k]});
            const bool inside = across != edges.end();
            beside[e][k] = inside ? static_cast<std::int32_t>(across->second) : Ground::edge;
        }
    }
    return beside;
}

double area_of(const Mesh& mesh, std::size_t element) {
    const Corners x = corners_of(mesh, element);
    return 0.5 * geometry::cross(x.col(2) - x.col(0), x.col(3) - x.col(1));
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
    // The ground ends where the section ends: below these corners the border is its sides.
    const double near = 1e-6 * (1.0 + std::abs(outermost));
    std::int32_t best = -1;
    for (const auto& [node, edge] : border) {
        if (sign * mesh.nodes[node].x() > outermost + near) continue;
        if (best < 0 || mesh.nodes[node].y() > mesh.nodes[best].y()) best = node;
    }
    return best;
}

/// Band number of elements above the threshold, connected by shared nodes; -1 outside.
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
            // By shared nodes: a band that runs across the quads diagonally meets at corners only.
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

/// Bands that meet the ground at several places.
struct Exits {
    std::size_t surfaces = 0;
    std::vector<bool> holds;  ///< [elements] in such a band
};

Exits exits_of(const Mesh& mesh, const Ground& ground, std::span<const double> epsilon_q,
               double threshold, double least_separation) {
    const std::vector<std::int32_t> band = bands_of(mesh, epsilon_q, threshold);
    std::map<std::int32_t, double> left_ground_at;  // end of a band's last contact so far [m]
    Exits exits{0, std::vector<bool>(mesh.quads.size(), false)};
    std::vector<bool> is_surface(mesh.quads.size(), false);  // by band
    for (std::size_t i = 0; i < ground.element.size(); ++i) {
        const std::int32_t b = band[ground.element[i]];
        if (b < 0) continue;
        const auto met = left_ground_at.find(b);
        // Along the ground and not in a straight line: across a crest the two ends of a narrow dam
        // are far apart.
        if (met != left_ground_at.end() && ground.begin[i] - met->second > least_separation) {
            ++exits.surfaces;
            is_surface[b] = true;
        }
        left_ground_at[b] = ground.end[i];
    }
    for (std::size_t e = 0; e < band.size(); ++e) {
        exits.holds[e] = band[e] >= 0 && is_surface[band[e]];
    }
    return exits;
}

/// Bodies that bands separate from the border at the sides and below.
struct CutOff {
    std::size_t bodies = 0;     ///< of sufficient area
    std::size_t valleys = 0;    ///< those within the bands of the threshold
    std::vector<bool> largest;  ///< [elements]
};

CutOff cut_off_by(const Mesh& mesh, const Ground& ground, const std::vector<bool>& bands,
                  const std::vector<bool>& of_threshold, double least_area) {
    CutOff cut{0, 0, std::vector<bool>(mesh.quads.size(), false)};
    std::vector<bool> seen = bands;
    for (std::size_t e = 0; e < ground.absent.size(); ++e) {
        if (ground.absent[e]) seen[e] = true;
    }
    double largest_area = 0.0;
    for (std::size_t first = 0; first < seen.size(); ++first) {
        if (seen[first]) continue;
        seen[first] = true;
        std::vector<std::size_t> body{first};
        bool held = false, within = true;
        double area = 0.0;
        for (std::size_t i = 0; i < body.size(); ++i) {
            area += area_of(mesh, body[i]);
            within = within && of_threshold[body[i]];
            for (const std::int32_t next : ground.beside[body[i]]) {
                held = held || next == Ground::edge;
                if (next < 0 || seen[next]) continue;
                seen[next] = true;
                body.push_back(static_cast<std::size_t>(next));
            }
        }
        // Soil that reaches the sides or the base is the ground that stays.
        if (held) continue;
        if (area >= least_area) ++(within ? cut.valleys : cut.bodies);
        if (area <= largest_area) continue;
        largest_area = area;
        cut.largest.assign(seen.size(), false);
        for (const std::size_t e : body) cut.largest[e] = true;
    }
    return cut;
}

/// Ground of a mesh without absent elements.
Ground ground_of_whole(const Mesh& mesh) {
    const Edges edges = edges_of(mesh);
    const auto border = border_of(edges);
    const std::int32_t last = upper_corner(mesh, border, Side::left);
    // The border runs counter-clockwise: along the ground from right to left.
    Ground ground;
    ground.beside = neighbours_of(mesh, edges);
    std::vector<double> length;
    for (std::int32_t node = upper_corner(mesh, border, Side::right); node != last;) {
        const BorderEdge& edge = border.at(node);
        ground.element.push_back(edge.element);
        const Quad& quad = mesh.quads[edge.element];
        const auto k = std::ranges::find(quad, node) - quad.begin();
        ground.beside[edge.element][static_cast<std::size_t>(k)] = Ground::air;
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

/// Edge of an element from corner k to the next.
struct Face {
    std::size_t element, k;

    std::int32_t from(const Mesh& mesh) const { return mesh.quads[element][k]; }
    std::int32_t to(const Mesh& mesh) const { return mesh.quads[element][(k + 1) % 4]; }
    std::size_t number() const { return 4 * element + k; }
};

/// The next border edge around the soil on its left.
Face after(const Mesh& mesh, const Ground& ground, Face face) {
    const std::int32_t node = face.to(mesh);
    face.k = (face.k + 1) % 4;
    // Turns around the node from element to element, until an edge without a neighbour.
    for (std::int32_t next; (next = ground.beside[face.element][face.k]) >= 0;) {
        const Quad& quad = mesh.quads[next];
        face = {static_cast<std::size_t>(next),
                static_cast<std::size_t>(std::ranges::find(quad, node) - quad.begin())};
    }
    return face;
}

/// Edges of the ground, chain by chain, each from right to left; without those of holes.
std::vector<std::vector<Face>> chains_of(const Mesh& mesh, const Ground& ground) {
    std::vector<Face> faces;
    for (std::size_t e = 0; e < mesh.quads.size(); ++e) {
        for (std::size_t k = 0; k < 4 && !ground.absent[e]; ++k) {
            if (ground.beside[e][k] == Ground::air) faces.push_back({e, k});
        }
    }
    const auto is_ground = [&](const Face& face) {
        return ground.beside[face.element][face.k] == Ground::air;
    };
    std::vector<bool> follows(4 * mesh.quads.size(), false);
    // A chain begins at an edge that follows none of the ground. Around a hole every edge follows
    // another.
    for (const Face& face : faces) follows[after(mesh, ground, face).number()] = true;
    std::vector<std::vector<Face>> chains;
    for (const Face& first : faces) {
        if (follows[first.number()]) continue;
        chains.emplace_back();
        for (Face face = first; is_ground(face); face = after(mesh, ground, face)) {
            chains.back().push_back(face);
        }
    }
    return chains;
}

/// The ground of the mesh without `absent`.
Ground ground_without(std::vector<char> absent, const Mesh& mesh, const Ground& whole) {
    Ground ground;
    ground.beside = whole.beside;
    ground.absent = std::move(absent);
    for (auto& beside : ground.beside) {
        for (std::int32_t& next : beside) {
            if (next >= 0 && ground.absent[next]) next = Ground::air;
        }
    }
    std::vector<std::vector<Face>> chains = chains_of(mesh, ground);
    for (auto& chain : chains) std::ranges::reverse(chain);
    const auto left_end = [&](const std::vector<Face>& chain) {
        return mesh.nodes[chain.front().to(mesh)];
    };
    std::ranges::sort(chains, {}, [&](const auto& chain) { return left_end(chain).x(); });
    double along = 0.0;
    for (std::size_t c = 0; c < chains.size(); ++c) {
        if (c > 0) {
            const Vec2& before = mesh.nodes[chains[c - 1].back().from(mesh)];
            along += (left_end(chains[c]) - before).norm();
        }
        for (const Face& face : chains[c]) {
            ground.element.push_back(face.element);
            ground.begin.push_back(along);
            along += (mesh.nodes[face.to(mesh)] - mesh.nodes[face.from(mesh)]).norm();
            ground.end.push_back(along);
        }
    }
    return ground;
}

}  // namespace

Ground ground_of(const Mesh& mesh, std::vector<char> absent) {
    Ground whole = ground_of_whole(mesh);
    if (std::ranges::find(absent, 1) == absent.end()) return whole;
    return ground_without(std::move(absent), mesh, whole);
}

FailureSurfaces failure_surfaces_of(const Mesh& mesh, const Ground& ground,
                                    std::span<const double> epsilon_q, double threshold,
                                    double least_separation) {
    const double least_area = least_separation * least_separation;
    Exits exits = exits_of(mesh, ground, epsilon_q, threshold, least_separation);
    FailureSurfaces surfaces{exits.surfaces, std::move(exits.holds),
                             std::vector<bool>(mesh.quads.size(), false)};
    if (surfaces.count == 0) return surfaces;
    CutOff cut = cut_off_by(mesh, ground, surfaces.holds, surfaces.holds, least_area);
    std::size_t valleys = 0;
    // Two slides that share one wide band leave no sound body between them: a valley of the strain
    // is then what separates them.
    for (const double times : {1.25, 1.5, 2.0, 3.0}) {
        std::vector<bool> ridges = surfaces.holds;
        for (std::size_t e = 0; e < ridges.size(); ++e) {
            if (epsilon_q[e] <= times * threshold) ridges[e] = false;
        }
        const CutOff between = cut_off_by(mesh, ground, ridges, surfaces.holds, least_area);
        valleys = std::max(valleys, between.valleys);
    }
    surfaces.count = std::max(surfaces.count, cut.bodies) + valleys;
    surfaces.slides = std::move(cut.largest);
    return surfaces;
}

}  // namespace breach::fem
