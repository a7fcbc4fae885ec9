// Layers below the water liquefy one after the other, so their borders follow the phreatic line,
// not the level. A cut may split a part into several pieces and leave slivers; vertices near a cut
// are moved to it and thin pieces absorbed, because each border becomes a line of the mesh.
#include "services/templates/layers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/geometry/polyline.hpp"
#include "core/geometry/thickness.hpp"

namespace breach::templates {

namespace {

/// Intersection of two segments, including their ends; nothing for parallel ones.
std::optional<Vec2> meeting(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
    const double little = 1e-12;
    const Vec2 u = b - a, v = d - c;
    // A cut along a side makes no piece.
    if (std::abs(geometry::cross(u, v)) <= little * u.norm() * v.norm()) return std::nullopt;
    const auto [at, s, t] = *geometry::crossing(a, b, c, d);
    if (s < -little || s > 1 + little || t < -little || t > 1 + little) return std::nullopt;
    return at;
}

/// The line extended beyond both sides of the polygon.
/// A part that reaches beyond the line is cut by its level continuation.
Line across(const Line& line, const Polygon& polygon) {
    const geometry::Box box = geometry::bounding_box(polygon);
    const double margin = 1.0 + (box.high - box.low).norm();
    Line all{{std::min(box.low.x(), line.front().x()) - margin, line.front().y()}};
    all.insert(all.end(), line.begin(), line.end());
    all.push_back({std::max(box.high.x(), line.back().x()) + margin, line.back().y()});
    return all;
}

/// Inserts the intersections with the line as vertices of the polygon; returns them from left to
/// right.
/// Points closer than `nearest` to a vertex use that vertex: a cut then ends in it, instead of
/// leaving a side that no element fits.
Line mark_meetings(Polygon& polygon, const Line& line, double nearest) {
    Polygon marked;
    Line meetings;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        Line on_side;
        for (std::size_t k = 1; k < line.size(); ++k)
            if (const auto place = meeting(a, b, line[k - 1], line[k])) on_side.push_back(*place);
        std::ranges::sort(on_side, {}, [&](const Vec2& place) { return (place - a).norm(); });
        marked.push_back(a);
        for (const Vec2& place : on_side) {
            const bool at_start = (place - a).norm() < nearest;
            const bool at_end = (place - b).norm() < nearest;
            const bool again = (place - marked.back()).norm() < nearest;
            if (at_start || at_end || again) {
                meetings.push_back(at_end ? b : at_start ? a : marked.back());
            } else {
                marked.push_back(place);
                meetings.push_back(place);
            }
        }
    }
    polygon = marked;
    std::ranges::sort(meetings, [](const Vec2& p, const Vec2& q) {
        return p.x() < q.x() || (p.x() == q.x() && p.y() < q.y());
    });
    // A vertex belongs to two sides and is met twice.
    const auto repeated = std::ranges::unique(meetings);
    meetings.erase(repeated.begin(), repeated.end());
    return meetings;
}

/// The part of the line through the polygon between two intersections.
Line way_between(const Vec2& from, const Vec2& to, const Line& line, double nearest) {
    Line way{from};
    for (const Vec2& kink : line)
        if (kink.x() > from.x() && kink.x() < to.x() && (kink - from).norm() >= nearest &&
            (kink - to).norm() >= nearest)
            way.push_back(kink);
    way.push_back(to);
    return way;
}

double distance_to_border(const Polygon& polygon, const Vec2& place) {
    double least = std::numeric_limits<double>::max();
    for (std::size_t i = 0; i < polygon.size(); ++i)
        least = std::min(least, geometry::distance_to_segment(place, polygon[i],
                                                              polygon[(i + 1) % polygon.size()]));
    return least;
}

/// Whether the path is inside except for its ends.
/// Between two neighbouring meetings the line may also run outside a part with a bay, or along its
/// border.
bool runs_inside(const Polygon& polygon, const Line& way, double little) {
    for (std::size_t k = 1; k < way.size(); ++k) {
        const Vec2 middle = 0.5 * (way[k - 1] + way[k]);
        if (!geometry::contains(polygon, middle) || distance_to_border(polygon, middle) < little)
            return false;
        if (k + 1 < way.size() && !geometry::contains(polygon, way[k])) return false;
    }
    return true;
}

/// Exact comparison is right here: places are copied, never computed a second time.
std::optional<std::size_t> vertex_at(const Polygon& polygon, const Vec2& place) {
    const auto found = std::ranges::find(polygon, place);
    if (found == polygon.end()) return std::nullopt;
    return static_cast<std::size_t>(found - polygon.begin());
}

/// Splits a polygon along a path between two of its vertices.
std::array<Polygon, 2> parted(const Polygon& polygon, std::size_t from, std::size_t to,
                              const Line& way) {
    const auto along = [&](std::size_t i, std::size_t end) {
        Polygon ring;
        for (; i != end; i = (i + 1) % polygon.size()) ring.push_back(polygon[i]);
        return ring;
    };
    Polygon one = along(from, to), other = along(to, from);
    for (std::size_t k = way.size() - 1; k > 0; --k) one.push_back(way[k]);
    for (std::size_t k = 0; k + 1 < way.size(); ++k) other.push_back(way[k]);
    return {one, other};
}

/// Depth below the line at the middle of the widest vertical extent of the polygon.
double depth_of(const Polygon& polygon, const Line& line) {
    const geometry::Box box = geometry::bounding_box(polygon);
    double widest = 0.0, depth = 0.0;
    for (const double share : {0.5, 0.27, 0.73, 0.11, 0.89, 0.03, 0.97}) {
        const double x = box.low.x() + share * (box.high.x() - box.low.x());
        std::vector<double> levels;
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
            if ((a.x() > x) == (b.x() > x)) continue;
            levels.push_back(a.y() + (b.y() - a.y()) * (x - a.x()) / (b.x() - a.x()));
        }
        std::ranges::sort(levels);
        // A vertical line goes in and out by turns.
        for (std::size_t i = 0; i + 1 < levels.size(); i += 2) {
            if (levels[i + 1] - levels[i] <= widest) continue;
            widest = levels[i + 1] - levels[i];
            depth = geometry::level_at(line, x) - 0.5 * (levels[i] + levels[i + 1]);
        }
    }
    return depth;
}

/// Whether side i of a ring, reversed, is a side of the other ring.
/// Rings are counter-clockwise, so neighbours run along a common side in opposite directions.
bool is_shared(const Polygon& ring, std::size_t i, const Polygon& other) {
    const Vec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
    for (std::size_t k = 0; k < other.size(); ++k)
        if (other[k] == b && other[(k + 1) % other.size()] == a) return true;
    return false;
}

/// The shared border of two rings, if it is one connected line.
struct Seam {
    std::size_t begin, sides;  ///< of the first ring
    double length = 0.0;
};

/// Two seams would enclose a hole when united.
std::optional<Seam> seam_between(const Polygon& one, const Polygon& other) {
    std::vector<Seam> seams;
    for (std::size_t i = 0; i < one.size(); ++i) {
        const std::size_t before = (i + one.size() - 1) % one.size();
        if (!is_shared(one, i, other) || is_shared(one, before, other)) continue;
        seams.push_back({i, 0, 0.0});
        for (std::size_t k = i; is_shared(one, k, other); k = (k + 1) % one.size()) {
            ++seams.back().sides;
            seams.back().length += (one[(k + 1) % one.size()] - one[k]).norm();
        }
    }
    if (seams.size() != 1) return std::nullopt;
    return seams.front();
}

/// Unites both rings along their seam.
Polygon united(const Polygon& one, const Polygon& other, const Seam& seam) {
    const std::size_t end = (seam.begin + seam.sides) % one.size();
    Polygon ring;
    for (std::size_t i = end; i != seam.begin; i = (i + 1) % one.size()) ring.push_back(one[i]);
    std::size_t k = *vertex_at(other, one[seam.begin]);
    for (; other[k] != one[end]; k = (k + 1) % other.size()) ring.push_back(other[k]);
    return ring;
}

/// The larger piece gives the number.
Layer joined(const Layer& one, const Layer& other, const Seam& seam) {
    const bool first = geometry::area(one.polygon) > geometry::area(other.polygon);
    return {first ? one.number : other.number, united(one.polygon, other.polygon, seam)};
}

/// Joins one thin piece with the neighbour with the longest common border; false: there is none.
/// Wet soil joins wet soil and dry joins dry if possible, because a layer that became dry would
/// keep its strength.
bool absorb_one(std::vector<Layer>& all, double thinnest) {
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (!geometry::thickness_below(thinnest, all[i].polygon)) continue;
        std::optional<Seam> best;
        std::size_t neighbour = i;
        bool best_is_alike = false;
        for (std::size_t k = 0; k < all.size(); ++k) {
            if (k == i) continue;
            const auto seam = seam_between(all[i].polygon, all[k].polygon);
            if (!seam) continue;
            const bool alike = (all[i].number > 0) == (all[k].number > 0);
            if (best && std::pair(alike, seam->length) <= std::pair(best_is_alike, best->length))
                continue;
            best = seam;
            best_is_alike = alike;
            neighbour = k;
        }
        // No neighbour has a single seam: the thin piece stays, and the scene's check may refuse
        // it.
        if (!best) continue;
        all[neighbour] = joined(all[i], all[neighbour], *best);
        all.erase(all.begin() + static_cast<std::ptrdiff_t>(i));
        return true;
    }
    return false;
}

Line lowered(Line line, double by) {
    for (Vec2& each : line) each.y() -= by;
    return line;
}

}  // namespace

std::vector<Polygon> divided(const Polygon& polygon, const Line& line, double nearest) {
    Polygon ring = polygon;
    const Line all = across(line, polygon);
    const Line meetings = mark_meetings(ring, all, nearest);
    const double little = 1e-3 * nearest;
    std::vector<Polygon> pieces{ring};
    for (std::size_t m = 1; m < meetings.size(); ++m) {
        const Line way = way_between(meetings[m - 1], meetings[m], all, nearest);
        // Each way splits the one piece that has both of its ends and the way inside.
        for (std::size_t p = 0; p < pieces.size(); ++p) {
            const auto from = vertex_at(pieces[p], way.front()),
                       to = vertex_at(pieces[p], way.back());
            if (!from || !to || !runs_inside(pieces[p], way, little)) continue;
            auto [one, other] = parted(pieces[p], *from, *to, way);
            pieces[p] = std::move(one);
            pieces.push_back(std::move(other));
            break;
        }
    }
    return pieces;
}

std::vector<Layer> cut_by_depth(const Polygon& polygon, const Line& phreatic, const Cut& cut) {
    double deepest = 0.0;
    for (const Vec2& vertex : polygon)
        deepest = std::max(deepest, geometry::level_at(phreatic, vertex.x()) - vertex.y());
    const int layers = static_cast<int>(std::max(1.0, std::floor(deepest / cut.thickness + 1e-9)));
    std::vector<Polygon> pieces{polygon};
    for (int k = 0; k < layers; ++k) {
        const Line line = lowered(phreatic, k * cut.thickness);
        std::vector<Polygon> next;
        for (const Polygon& each : pieces)
            std::ranges::move(divided(each, line, cut.nearest), std::back_inserter(next));
        pieces = std::move(next);
    }
    std::vector<Layer> all;
    for (Polygon& each : pieces) {
        const double depth = depth_of(each, phreatic);
        const int below = 1 + static_cast<int>(std::floor(depth / cut.thickness));
        all.push_back({depth <= 0.0 ? 0 : std::min(below, layers), std::move(each)});
    }
    // Again from the start after each union: a united piece may be thick enough, or still too thin.
    while (absorb_one(all, cut.thinnest)) {
    }
    std::ranges::stable_sort(all, {}, &Layer::number);
    return all;
}

/// Neighbours may be made with different vertices on a common side; the mesh needs the same ones on
/// both. Vertices are copied, so that equal places are equal numbers.
void share_vertices(std::vector<Part>& parts) {
    for (Part& part : parts) {
        Polygon shared;
        for (std::size_t i = 0; i < part.polygon.size(); ++i) {
            const Vec2 &a = part.polygon[i], &b = part.polygon[(i + 1) % part.polygon.size()];
            const double little = 1e-9 * (1.0 + (b - a).norm());
            Line on_side;
            for (const Part& other : parts)
                for (const Vec2& vertex : other.polygon)
                    if (vertex != a && vertex != b &&
                        geometry::distance_to_segment(vertex, a, b) < little &&
                        (vertex - a).norm() > little && (vertex - b).norm() > little &&
                        std::ranges::find(on_side, vertex) == on_side.end())
                        on_side.push_back(vertex);
            std::ranges::sort(on_side, {}, [&](const Vec2& place) { return (place - a).norm(); });
            shared.push_back(a);
            shared.insert(shared.end(), on_side.begin(), on_side.end());
        }
        part.polygon = std::move(shared);
    }
}

}  // namespace breach::templates
