#include "core/geometry/thickness.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>

namespace breach::geometry {

namespace {

struct Disc {
    Vec2 center;
    double radius;
};

/// Touching polygons as one shape: common borders are inside.
struct Shape {
    std::vector<Polygon> parts;
    std::vector<Side> border;
};

bool lies_on(const Vec2& point, const Polygon& polygon, double tolerance) {
    return std::ranges::any_of(sides_of(polygon), [&](const Side& side) {
        return distance_to_segment(point, side.a, side.b) < tolerance;
    });
}

/// Splits an edge at vertices of other polygons.
std::vector<Side> pieces_of(const Side& edge, const std::vector<Polygon>& others,
                            double tolerance) {
    std::vector<Vec2> cuts{edge.a, edge.b};
    for (const Polygon& other : others) {
        for (const Vec2& vertex : other) {
            if (distance_to_segment(vertex, edge.a, edge.b) < tolerance) cuts.push_back(vertex);
        }
    }
    std::ranges::sort(cuts, {}, [&](const Vec2& cut) { return (cut - edge.a).norm(); });
    std::vector<Side> pieces;
    for (std::size_t i = 1; i < cuts.size(); ++i) {
        if ((cuts[i] - cuts[i - 1]).norm() > tolerance) pieces.push_back({cuts[i - 1], cuts[i]});
    }
    return pieces;
}

/// Pieces of a polygon's edges shared with other polygons, or not.
enum class Border { shared, own };
std::vector<Side> pieces_of(const Polygon& polygon, const std::vector<Polygon>& others,
                            Border wanted) {
    const Box box = bounding_box(polygon);
    const double tolerance = 1e-6 * (box.high - box.low).norm();
    std::vector<Side> found;
    for (const Side& edge : sides_of(polygon)) {
        for (const Side& piece : pieces_of(edge, others, tolerance)) {
            const Vec2 middle = 0.5 * (piece.a + piece.b);
            const bool shared = std::ranges::any_of(
                others, [&](const Polygon& other) { return lies_on(middle, other, tolerance); });
            if (shared == (wanted == Border::shared)) found.push_back(piece);
        }
    }
    return found;
}

Shape shape_of(const std::vector<Polygon>& parts) {
    Shape shape{parts, {}};
    for (std::size_t i = 0; i < parts.size(); ++i) {
        std::vector<Polygon> others = parts;
        others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
        std::ranges::move(pieces_of(parts[i], others, Border::own),
                          std::back_inserter(shape.border));
    }
    return shape;
}

double distance_to_border(const Shape& shape, const Vec2& point) {
    double least = std::numeric_limits<double>::max();
    for (const Side& side : shape.border)
        least = std::min(least, squared_distance_to_segment(point, side.a, side.b));
    return std::sqrt(least);
}

double perimeter(const Polygon& polygon) {
    double sum = 0.0;
    for (const Side& side : sides_of(polygon)) sum += (side.b - side.a).norm();
    return sum;
}

bool holds(const Shape& shape, const Vec2& point) {
    return std::ranges::any_of(shape.parts,
                               [&](const Polygon& part) { return contains(part, point); });
}

constexpr double places_wanted = 250.0;

double spacing_of(const Polygon& polygon) { return std::sqrt(area(polygon) / places_wanted); }

/// A few hundred lattice points inside.
std::vector<Vec2> places_inside(const Polygon& polygon) {
    const Box box = bounding_box(polygon);
    const Vec2 extent = box.high - box.low;
    const auto lines = [&](double length) {
        const double wanted = std::ceil(length / spacing_of(polygon));
        return static_cast<int>(std::clamp(wanted, 4.0, places_wanted));
    };
    const int columns = lines(extent.x());
    const int rows = lines(extent.y());
    std::vector<Vec2> places;
    for (int i = 0; i < columns; ++i) {
        for (int j = 0; j < rows; ++j) {
            const Vec2 share{(i + 0.5) / columns, (j + 0.5) / rows};
            const Vec2 place = box.low + extent.cwiseProduct(share);
            if (contains(polygon, place)) places.push_back(place);
        }
    }
    return places;
}

template <std::size_t count>
std::array<Vec2, count> half_circle() {
    std::array<Vec2, count> directions;
    for (std::size_t k = 0; k < count; ++k) {
        const double angle = std::numbers::pi * static_cast<double>(k) / count;
        directions[k] = {std::cos(angle), std::sin(angle)};
    }
    return directions;
}

/// Middle of the shortest chord through a place: near the medial axis, on which the largest discs
/// have their centres.
Vec2 middle_of_shortest_chord(const Shape& shape, const Vec2& place) {
    static const std::array<Vec2, 16> directions = half_circle<16>();
    double shortest = std::numeric_limits<double>::max();
    Vec2 middle = place;
    for (const Vec2& along : directions) {
        const Vec2 normal{-along.y(), along.x()};
        double ahead = std::numeric_limits<double>::max();
        double behind = ahead;
        for (const Side& side : shape.border) {
            const Vec2 a = side.a - place;
            const Vec2 b = side.b - place;
            const double from = normal.dot(a);
            const double to = normal.dot(b);
            if ((from > 0.0) == (to > 0.0)) continue;
            const double s = along.dot(a) + along.dot(b - a) * from / (from - to);
            if (s >= 0.0) ahead = std::min(ahead, s);
            if (s <= 0.0) behind = std::min(behind, -s);
        }
        if (ahead + behind >= shortest) continue;
        shortest = ahead + behind;
        middle = place + 0.5 * (ahead - behind) * along;
    }
    return middle;
}

/// The largest disc near a place, by hill climbing with halved steps.
Disc largest_disc_near(const Shape& shape, const Vec2& place) {
    Disc disc{place, distance_to_border(shape, place)};
    for (double step = 0.5 * disc.radius; step > 0.03 * disc.radius; step *= 0.5) {
        for (bool climbs = true; climbs;) {
            climbs = false;
            for (const Vec2& way : {Vec2{step, 0}, Vec2{-step, 0}, Vec2{0, step}, Vec2{0, -step}}) {
                const Vec2 center = disc.center + way;
                const double radius = distance_to_border(shape, center);
                if (radius < 1.02 * disc.radius || !holds(shape, center)) continue;
                disc = {center, radius};
                climbs = true;
            }
        }
    }
    return disc;
}

/// Whether the median is at least the limit. Thicknesses only grow, so a true result is final.
bool reach(double limit, const std::vector<double>& thickness) {
    const auto thin = std::ranges::count_if(thickness, [&](double each) { return each < limit; });
    return static_cast<std::size_t>(thin) <= thickness.size() / 2;
}

}  // namespace

std::optional<double> thickness_below(double limit, const Polygon& polygon,
                                      const std::vector<Polygon>& attached) {
    std::vector<Polygon> parts = attached;
    parts.push_back(polygon);
    const Shape shape = shape_of(parts);
    const std::vector<Vec2> places = places_inside(polygon);
    // Too thin for the lattice: use 2 area / perimeter.
    std::vector<double> thickness{2.0 * area(polygon) / perimeter(polygon)};
    if (!places.empty()) thickness.clear();
    for (const Vec2& place : places) thickness.push_back(2.0 * distance_to_border(shape, place));
    for (const Vec2& each : places) {
        if (reach(limit, thickness)) return std::nullopt;
        const Disc disc = largest_disc_near(shape, middle_of_shortest_chord(shape, each));
        for (std::size_t i = 0; i < places.size(); ++i)
            if (2.0 * disc.radius > thickness[i] && (disc.center - places[i]).norm() <= disc.radius)
                thickness[i] = 2.0 * disc.radius;
    }
    const auto middle = thickness.begin() + static_cast<std::ptrdiff_t>(thickness.size() / 2);
    std::ranges::nth_element(thickness, middle);
    return *middle < limit ? std::optional(*middle) : std::nullopt;
}

double thickness_of(const Polygon& polygon, const std::vector<Polygon>& attached) {
    return *thickness_below(std::numeric_limits<double>::infinity(), polygon, attached);
}

bool touch(const Polygon& a, const Polygon& b) {
    return !pieces_of(a, {b}, Border::shared).empty();
}

}  // namespace breach::geometry
