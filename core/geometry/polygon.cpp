#include "core/geometry/polygon.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "core/geometry/polyline.hpp"

namespace breach::geometry {

namespace {

double turn(const Vec2& a, const Vec2& b, const Vec2& c) { return cross(b - a, c - a); }

double extent(const Polygon& polygon) {
    const Box box = bounding_box(polygon);
    return (box.high - box.low).maxCoeff();
}

bool segments_meet(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d, double tolerance) {
    const double t1 = turn(a, b, c);
    const double t2 = turn(a, b, d);
    const double t3 = turn(c, d, a);
    const double t4 = turn(c, d, b);
    if (((t1 > 0) != (t2 > 0)) && ((t3 > 0) != (t4 > 0)) && t1 != 0 && t2 != 0 && t3 != 0 &&
        t4 != 0) {
        return true;
    }
    return distance_to_segment(c, a, b) < tolerance || distance_to_segment(d, a, b) < tolerance ||
           distance_to_segment(a, c, d) < tolerance || distance_to_segment(b, c, d) < tolerance;
}

std::string named(const Vec2& point) {
    std::ostringstream text;
    text << "(" << point.x() << ", " << point.y() << ")";
    return text.str();
}

using Triangle = std::array<Vec2, 3>;

/// Ear clipping of a simple counter-clockwise polygon.
std::vector<Triangle> triangles(Polygon polygon) {
    std::vector<Triangle> result;
    if (signed_area(polygon) < 0) std::reverse(polygon.begin(), polygon.end());
    while (polygon.size() > 3) {
        const std::size_t n = polygon.size();
        bool clipped = false;
        for (std::size_t i = 0; i < n && !clipped; ++i) {
            const Vec2& a = polygon[(i + n - 1) % n];
            const Vec2& b = polygon[i];
            const Vec2& c = polygon[(i + 1) % n];
            const double bend = turn(a, b, c);
            if (bend < 0) continue;
            // Vertices on the border block too: the rest must not pass through a vertex.
            const bool blocked =
                bend > 0 && std::any_of(polygon.begin(), polygon.end(), [&](const Vec2& p) {
                    return p != a && p != b && p != c && turn(a, b, p) >= 0 && turn(b, c, p) >= 0 &&
                           turn(c, a, p) >= 0;
                });
            if (blocked) continue;
            result.push_back({a, b, c});
            polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(i));
            clipped = true;
        }
        if (!clipped) return result;  // not simple; defect() reports it
    }
    result.push_back({polygon[0], polygon[1], polygon[2]});
    return result;
}

}  // namespace

std::vector<Side> sides_of(const Polygon& polygon) {
    std::vector<Side> sides;
    for (std::size_t i = 0; i < polygon.size(); ++i)
        sides.push_back({polygon[i], polygon[(i + 1) % polygon.size()]});
    return sides;
}

double signed_area(const Polygon& polygon) {
    double twice = 0.0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        twice += cross(polygon[i], polygon[(i + 1) % polygon.size()]);
    }
    return 0.5 * twice;
}

double area(const Polygon& polygon) { return std::abs(signed_area(polygon)); }

double squared_distance_to_segment(const Vec2& point, const Vec2& from, const Vec2& to) {
    const Vec2 along = to - from;
    const double length2 = along.squaredNorm();
    const double s = length2 > 0 ? std::clamp((point - from).dot(along) / length2, 0.0, 1.0) : 0.0;
    return (point - from - s * along).squaredNorm();
}

double distance_to_segment(const Vec2& point, const Vec2& from, const Vec2& to) {
    return std::sqrt(squared_distance_to_segment(point, from, to));
}

bool contains(const Polygon& polygon, const Vec2& point, double tolerance) {
    bool inside = false;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec2& a = polygon[i];
        const Vec2& b = polygon[(i + 1) % polygon.size()];
        if (distance_to_segment(point, a, b) <= tolerance) return true;
        if ((a.y() > point.y()) != (b.y() > point.y()) &&
            point.x() < a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) {
            inside = !inside;
        }
    }
    return inside;
}

std::optional<std::string> defect(const Polygon& polygon) {
    const std::size_t n = polygon.size();
    if (n < 3) return "has fewer than three different vertices";
    const double tolerance = 1e-12 * extent(polygon);
    for (std::size_t i = 0; i < n; ++i) {
        if ((polygon[i] - polygon[(i + 1) % n]).norm() <= tolerance) {
            return "repeats the vertex " + named(polygon[i]);
        }
    }
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = i + 2; j < n; ++j) {
            if (i == 0 && j == n - 1) continue;
            if (segments_meet(polygon[i], polygon[i + 1], polygon[j], polygon[(j + 1) % n],
                              tolerance)) {
                return "crosses or touches itself: the edges from " + named(polygon[i]) +
                       " and from " + named(polygon[j]) + " meet";
            }
        }
    }
    if (area(polygon) <= tolerance * extent(polygon)) return "encloses no area";
    return std::nullopt;
}

Polygon clipped_left(const Polygon& subject, const Vec2& a, const Vec2& b) {
    Polygon result;
    for (std::size_t i = 0; i < subject.size(); ++i) {
        const Vec2& p = subject[i];
        const Vec2& q = subject[(i + 1) % subject.size()];
        const double tp = turn(a, b, p);
        const double tq = turn(a, b, q);
        if (tp >= 0) result.push_back(p);
        if ((tp > 0 && tq < 0) || (tp < 0 && tq > 0)) {
            const Vec2 cut = p + (q - p) * (tp / (tp - tq));
            result.push_back(cut);
        }
    }
    return result;
}

double overlap_area(const Polygon& a, const Polygon& b) {
    double sum = 0.0;
    const std::vector<Triangle> of_b = triangles(b);
    for (const Triangle& s : triangles(a)) {
        for (const Triangle& t : of_b) {
            Polygon shared(s.begin(), s.end());
            for (std::size_t k = 0; k < 3 && !shared.empty(); ++k) {
                shared = clipped_left(shared, t[k], t[(k + 1) % 3]);
            }
            if (shared.size() >= 3) sum += area(shared);
        }
    }
    return sum;
}

Box bounding_box(const Polygon& polygon) {
    Box box{polygon.front(), polygon.front()};
    for (const Vec2& p : polygon) {
        box.low = box.low.cwiseMin(p);
        box.high = box.high.cwiseMax(p);
    }
    return box;
}

}  // namespace breach::geometry
