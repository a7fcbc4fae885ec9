// Puts all outlines on common nodes: vertices within the tolerance become one, edges are bent to
// nodes near them and cut where they cross. Repeated until nothing moves, as bending an edge can
// bring it near another node. The first outline decides a node's place, so the order of the
// drawing matters and is kept.
#include "services/import/arrangement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "core/geometry/polyline.hpp"

namespace breach::importing {

namespace {

/// Drawings settle in a few passes; one that does not is reported as unsettled
/// (Snapped::settled).
constexpr int most_passes = 20;
constexpr std::size_t most_nodes = 8000, most_steps = 40000;  // limits where lines cross everywhere

// ---------------------------------------------------------------- snapping

/// Nodes only are added, never moved: a drawing settles, or the limit on passes ends it.
class Snapping {
  public:
    Snapping(const std::vector<Chain>& chains, double tolerance)
        : chains_(chains), tolerance_(tolerance) {}

    Snapped result() {
        for (std::size_t c = 0; c < chains_.size(); ++c) join_vertices(c);
        result_.settled = false;
        for (int pass = 0; pass < most_passes && !result_.settled && !is_tangle(); ++pass) {
            const bool bent = bend_edges();
            result_.settled = !is_tangle() && !cross_edges() && !bent;
        }
        return std::move(result_);
    }

  private:
    // Beyond these limits the work grows with the square of the nodes.
    bool is_tangle() const {
        std::size_t steps = 0;
        for (const auto& each : result_.chains) steps += each.size();
        return result_.nodes.size() > most_nodes || steps > most_steps;
    }

    std::size_t new_node(const Vec2& place, std::size_t chain) {
        result_.nodes.push_back(place);
        drawn_by_.push_back(chain);
        return result_.nodes.size() - 1;
    }

    /// A plain loop: most_nodes bounds it, and a tree would have to follow every new node.
    std::optional<std::size_t> node_near(const Vec2& place) const {
        std::optional<std::size_t> nearest;
        double least = tolerance_;
        for (std::size_t i = 0; i < result_.nodes.size(); ++i) {
            const double distance = (result_.nodes[i] - place).norm();
            if (distance > least) continue;
            least = distance;
            nearest = i;
        }
        return nearest;
    }

    /// In the order of the outlines: the node of the first one stays.
    void join_vertices(std::size_t c) {
        std::vector<std::size_t> along;
        for (const Vec2& each : chains_[c].points) {
            const auto known = node_near(each);
            const std::size_t node = known ? *known : new_node(each, c);
            if (!along.empty() && along.back() == node) continue;
            along.push_back(node);
            if (known && drawn_by_[node] != c && result_.nodes[node] != each)
                result_.meetings.push_back({c, drawn_by_[node], result_.nodes[node], each, false});
        }
        while (chains_[c].closed && along.size() > 1 && along.front() == along.back())
            along.pop_back();
        result_.chains.push_back(std::move(along));
    }

    /// A closed chain has an edge from its last node to its first.
    std::size_t edges_in(std::size_t c) const {
        const std::size_t n = result_.chains[c].size();
        return n < 2 ? 0 : chains_[c].closed ? n : n - 1;
    }

    struct Insertion {
        double along;  ///< share of the edge
        std::size_t node;
    };

    /// Inserts nodes within the tolerance of an edge into the edge.
    bool bend_edges() {
        bool changed = false;
        for (std::size_t c = 0; c < result_.chains.size(); ++c) {
            std::vector<std::vector<Insertion>> insertions(edges_in(c));
            for (std::size_t e = 0; e < insertions.size(); ++e) insertions[e] = nodes_beside(c, e);
            changed |= insert(c, std::move(insertions));
        }
        return changed;
    }

    /// The box around the edge, widened by the tolerance, spares the distance for most nodes.
    /// A foot at or beyond an end is left to that end's own node.
    std::vector<Insertion> nodes_beside(std::size_t c, std::size_t e) {
        const auto& chain = result_.chains[c];
        const std::size_t a = chain[e], b = chain[(e + 1) % chain.size()];
        const Vec2 A = result_.nodes[a], along = result_.nodes[b] - A;
        const double length2 = along.squaredNorm();
        const Vec2 low = A.cwiseMin(result_.nodes[b]).array() - tolerance_;
        const Vec2 high = A.cwiseMax(result_.nodes[b]).array() + tolerance_;
        std::vector<Insertion> found;
        for (std::size_t w = 0; w < result_.nodes.size(); ++w) {
            const Vec2& W = result_.nodes[w];
            if (w == a || w == b || (W.array() < low.array()).any() ||
                (W.array() > high.array()).any())
                continue;
            const double share = (W - A).dot(along) / length2;
            if (share <= 0.0 || share >= 1.0) continue;
            const Vec2 foot = A + share * along;
            if ((W - foot).norm() > tolerance_) continue;
            found.push_back({share, w});
            if (drawn_by_[w] != c) result_.meetings.push_back({c, drawn_by_[w], W, foot, true});
        }
        return found;
    }

    /// True if the chain got longer: another pass is due.
    bool insert(std::size_t c, std::vector<std::vector<Insertion>> insertions) {
        bool changed = false;
        std::vector<std::size_t> along;
        const auto& chain = result_.chains[c];
        for (std::size_t i = 0; i < chain.size(); ++i) {
            along.push_back(chain[i]);
            if (i >= insertions.size()) continue;
            std::ranges::sort(insertions[i], {}, &Insertion::along);
            for (const Insertion& each : insertions[i]) {
                if (along.back() == each.node) continue;
                along.push_back(each.node);
                changed = true;
            }
        }
        result_.chains[c] = std::move(along);
        return changed;
    }

    struct Segment {
        std::size_t chain, edge, a, b;
    };

    /// A sweep from left to right: only segments that overlap in x are compared. Two edges shared
    /// by several chains get one node, not one per pair of chains.
    bool cross_edges() {
        std::vector<Segment> segments;
        std::vector<std::vector<std::vector<Insertion>>> insertions(result_.chains.size());
        for (std::size_t c = 0; c < result_.chains.size(); ++c) {
            const auto& chain = result_.chains[c];
            insertions[c].resize(edges_in(c));
            for (std::size_t e = 0; e < insertions[c].size(); ++e)
                segments.push_back({c, e, chain[e], chain[(e + 1) % chain.size()]});
        }
        const auto left = [&](const Segment& s) {
            return std::min(result_.nodes[s.a].x(), result_.nodes[s.b].x());
        };
        std::ranges::stable_sort(segments, {}, left);
        bool changed = false;
        std::map<std::pair<Edge, Edge>, std::size_t> known;  // several chains may share an edge
        for (std::size_t i = 0; i < segments.size(); ++i) {
            const Segment& s = segments[i];
            const double right = std::max(result_.nodes[s.a].x(), result_.nodes[s.b].x());
            for (std::size_t j = i + 1; j < segments.size() && left(segments[j]) <= right; ++j) {
                const Segment& t = segments[j];
                const auto place = crossing(s, t);
                if (!place) continue;
                const Edge one = edge_of(s.a, s.b), other = edge_of(t.a, t.b);
                const std::pair<Edge, Edge> key = std::minmax(one, other);
                const auto [entry, fresh] = known.try_emplace(key, 0);
                if (fresh) {
                    if (known.size() > most_nodes) return true;
                    const auto near = node_near(place->at);
                    entry->second = near ? *near : new_node(place->at, s.chain);
                }
                const std::size_t node = entry->second;
                if (node != s.a && node != s.b)
                    insertions[s.chain][s.edge].push_back({place->on_first, node});
                if (node != t.a && node != t.b)
                    insertions[t.chain][t.edge].push_back({place->on_second, node});
            }
        }
        for (std::size_t c = 0; c < result_.chains.size(); ++c)
            changed |= insert(c, std::move(insertions[c]));
        return changed;
    }

    /// Edges that share a node meet there and nowhere else.
    std::optional<geometry::Crossing> crossing(const Segment& s, const Segment& t) const {
        if (s.a == t.a || s.a == t.b || s.b == t.a || s.b == t.b) return std::nullopt;
        const std::vector<Vec2>& nodes = result_.nodes;
        const auto place = geometry::crossing(nodes[s.a], nodes[s.b], nodes[t.a], nodes[t.b]);
        return place && place->is_within() ? place : std::nullopt;
    }

    const std::vector<Chain>& chains_;
    double tolerance_;
    Snapped result_{};
    std::vector<std::size_t> drawn_by_;  ///< per node
};

// ---------------------------------------------------------------- faces

/// The node after v on the face left of u-v: the first one clockwise from v-u.
class Fan {
  public:
    Fan(const std::vector<Vec2>& nodes, const std::vector<Edge>& directed) : around_(nodes.size()) {
        for (const auto& [from, to] : directed) {
            const Vec2 way = nodes[to] - nodes[from];
            around_[from].push_back({std::atan2(way.y(), way.x()), to});
        }
        for (auto& each : around_) std::ranges::sort(each);
        nodes_ = &nodes;
    }

    std::size_t after(std::size_t u, std::size_t v) const {
        const Vec2 back = (*nodes_)[u] - (*nodes_)[v];
        const std::pair<double, std::size_t> way{std::atan2(back.y(), back.x()), u};
        const auto& fan = around_[v];
        const auto at = std::ranges::lower_bound(fan, way);
        return at == fan.begin() ? fan.back().second : std::prev(at)->second;
    }

  private:
    const std::vector<Vec2>* nodes_;
    std::vector<std::vector<std::pair<double, std::size_t>>> around_;
};

/// Closed walks along directed edges, each used once.
/// Starts at the smallest edge that is left, so that the result depends on the drawing alone.
std::vector<std::vector<std::size_t>> walks(const std::vector<Vec2>& nodes,
                                            const std::vector<Edge>& directed) {
    const Fan fan(nodes, directed);
    std::set<Edge> open(directed.begin(), directed.end());
    std::vector<std::vector<std::size_t>> rings;
    while (!open.empty()) {
        Edge at = *open.begin();
        std::vector<std::size_t> ring;
        while (open.erase(at) == 1) {
            ring.push_back(at.first);
            at = {at.second, fan.after(at.first, at.second)};
        }
        rings.push_back(std::move(ring));
    }
    return rings;
}

/// To the ring's sides, not only to its vertices.
double least_distance(const Vec2& place, const Polygon& ring) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < ring.size(); ++i)
        least = std::min(
            least, geometry::distance_to_segment(place, ring[i], ring[(i + 1) % ring.size()]));
    return least;
}

/// Levels midway between vertices, at most 48: those in the widest gaps.
/// A vertex is often a tip, where a circle has no room.
std::vector<double> levels_between(const Polygon& ring) {
    std::vector<double> ys;
    for (const Vec2& each : ring) ys.push_back(each.y());
    std::ranges::sort(ys);
    std::vector<std::pair<double, double>> bands;  // height, middle
    for (std::size_t i = 0; i + 1 < ys.size(); ++i)
        if (ys[i + 1] > ys[i]) bands.emplace_back(ys[i + 1] - ys[i], 0.5 * (ys[i] + ys[i + 1]));
    std::ranges::sort(bands, std::greater<>());
    if (bands.size() > 48) bands.resize(48);
    std::vector<double> levels;
    for (const auto& [height, middle] : bands) levels.push_back(middle);
    return levels;
}

/// Midpoints of the parts of a level inside the ring.
std::vector<Vec2> middles_at(const Polygon& ring, double y) {
    std::vector<double> xs;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
        if ((a.y() > y) == (b.y() > y)) continue;
        xs.push_back(a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
    }
    std::ranges::sort(xs);
    std::vector<Vec2> middles;
    for (std::size_t i = 0; i + 1 < xs.size(); i += 2)
        middles.emplace_back(0.5 * (xs[i] + xs[i + 1]), y);
    return middles;
}

/// Places the largest of the tried circles; `others` may lie within the ring.
/// Whether a soil contains a face is tested at `inside` alone: the centroid of a bent face may lie
/// outside of it.
void find_inside(Face& face, const Polygon& ring, const std::vector<Polygon>& others) {
    face.width = 0.0;
    face.inside = ring.front();
    for (const double y : levels_between(ring))
        for (const Vec2& place : middles_at(ring, y)) {
            const bool taken = std::ranges::any_of(
                others, [&](const Polygon& each) { return geometry::contains(each, place); });
            if (taken) continue;
            const double width = 2.0 * least_distance(place, ring);
            if (width <= face.width) continue;
            face.width = width;
            face.inside = place;
        }
}

}  // namespace

Snapped snapped(const std::vector<Chain>& chains, double tolerance) {
    return Snapping(chains, tolerance).result();
}

Edge edge_of(std::size_t a, std::size_t b) { return {std::min(a, b), std::max(a, b)}; }

std::vector<Edge> edges_of(const Snapped& snapped, std::size_t chain, bool closed) {
    const auto& along = snapped.chains[chain];
    std::set<Edge> edges;
    for (std::size_t i = 0; i + 1 < along.size(); ++i)
        edges.insert(edge_of(along[i], along[i + 1]));
    if (closed && along.size() > 2) edges.insert(edge_of(along.back(), along.front()));
    return {edges.begin(), edges.end()};
}

Polygon polygon_of(const std::vector<Vec2>& nodes, const std::vector<std::size_t>& ring) {
    Polygon polygon;
    for (const std::size_t each : ring) polygon.push_back(nodes[each]);
    return polygon;
}

/// Each edge is walked once in either direction; faces lie to the left, and the walk around the
/// outside has a negative area.
std::vector<Face> faces_of(const std::vector<Vec2>& nodes, const std::vector<Edge>& edges) {
    std::vector<Edge> directed;
    for (const auto& [a, b] : edges) {
        directed.push_back({a, b});
        directed.push_back({b, a});
    }
    std::vector<Face> faces;
    std::vector<Polygon> rings;
    for (auto& ring : walks(nodes, directed)) {
        Polygon polygon = polygon_of(nodes, ring);
        const double area = geometry::signed_area(polygon);
        if (ring.size() < 3 || !(area > 0.0)) continue;  // the outer boundary
        faces.push_back({std::move(ring), Vec2::Zero(), 0.0, area});
        rings.push_back(std::move(polygon));
    }
    for (std::size_t i = 0; i < faces.size(); ++i) {
        std::vector<Polygon> within;  // of parts that touch nothing around them
        for (std::size_t j = 0; j < faces.size(); ++j)
            if (j != i && faces[j].area < faces[i].area &&
                geometry::contains(rings[i], rings[j].front()) &&
                std::ranges::find(faces[i].ring, faces[j].ring.front()) == faces[i].ring.end())
                within.push_back(rings[j]);
        find_inside(faces[i], rings[i], within);
    }
    return faces;
}

/// An edge between two of the faces is walked in both directions and cancels.
std::vector<std::vector<std::size_t>> union_of(const std::vector<Vec2>& nodes,
                                               const std::vector<const Face*>& faces) {
    std::set<Edge> border;
    for (const Face* face : faces) {
        for (std::size_t i = 0; i < face->ring.size(); ++i) {
            const std::size_t a = face->ring[i], b = face->ring[(i + 1) % face->ring.size()];
            if (border.erase({b, a}) == 0) border.insert({a, b});
        }
    }
    return walks(nodes, {border.begin(), border.end()});
}

}  // namespace breach::importing
