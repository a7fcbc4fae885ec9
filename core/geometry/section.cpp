#include "core/geometry/section.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

namespace breach::geometry {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double same_share = 1e-9;  // of the section's length

double level_on(const Side& side, double x) {
    return side.a.y() + (x - side.a.x()) / (side.b.x() - side.a.x()) * (side.b.y() - side.a.y());
}

/// The highest side at x, oriented from left to right.
std::optional<Side> top_side(const Outlines& outlines, double x) {
    std::optional<Side> top;
    for (const Polygon* each : outlines)
        for (Side side : sides_of(*each)) {
            if ((side.a.x() <= x) == (side.b.x() <= x)) continue;
            if (side.a.x() > side.b.x()) std::swap(side.a, side.b);
            if (!top || level_on(side, x) > level_on(*top, x)) top = side;
        }
    return top;
}

}  // namespace

Box extent(const Outlines& outlines) {
    Box all{Vec2::Constant(infinity), Vec2::Constant(-infinity)};
    for (const Polygon* each : outlines)
        for (const Vec2& vertex : *each)
            all = {all.low.cwiseMin(vertex), all.high.cwiseMax(vertex)};
    return all;
}

bool in_soil(const Outlines& outlines, const Vec2& place, double tolerance) {
    return std::ranges::any_of(
        outlines, [&](const Polygon* each) { return contains(*each, place, tolerance); });
}

double distance_to_soil(const Outlines& outlines, const Vec2& place) {
    if (in_soil(outlines, place)) return 0.0;
    double least = infinity;
    for (const Polygon* each : outlines)
        for (const Side& side : sides_of(*each))
            least = std::min(least, distance_to_segment(place, side.a, side.b));
    return least;
}

std::vector<double> crossings(const Polygon& polygon, double x) {
    std::vector<double> heights;
    for (const Side& side : sides_of(polygon))
        if ((side.a.x() <= x) != (side.b.x() <= x))
            heights.push_back(on_straight(side.a, side.b, x));
    std::ranges::sort(heights);
    return heights;
}

std::vector<Stratum> strata_at(const Outlines& outlines, double x) {
    std::vector<Stratum> strata;
    for (std::size_t r = 0; r < outlines.size(); ++r) {
        const std::vector<double> levels = crossings(*outlines[r], x);
        for (std::size_t i = levels.size(); i > 1; i -= 2)
            strata.push_back({levels[i - 1], levels[i - 2], r});
    }
    std::ranges::sort(strata, std::greater<>(), &Stratum::top);
    return strata;
}

Upright upright_at(const Outlines& outlines, double x, double tolerance) {
    std::vector<std::array<double, 2>> parts;
    Upright reach{infinity, -infinity, false};
    for (const Polygon* each : outlines) {
        for (const Side& side : sides_of(*each)) {
            if (std::abs(side.a.x() - x) > tolerance) continue;
            reach.low = std::min(reach.low, side.a.y());
            reach.high = std::max(reach.high, side.a.y());
            if (std::abs(side.b.x() - x) > tolerance) continue;
            parts.push_back({std::min(side.a.y(), side.b.y()), std::max(side.a.y(), side.b.y())});
        }
    }
    std::ranges::sort(parts);
    double reached = reach.low;
    for (const auto& part : parts) {
        if (part[0] > reached + tolerance) break;
        reached = std::max(reached, part[1]);
    }
    reach.unbroken = !parts.empty() && reached >= reach.high - tolerance;
    return reach;
}

double ground_at(const Outlines& outlines, double x) {
    double ground = -infinity;
    for (const Polygon* each : outlines)
        if (const std::vector<double> heights = crossings(*each, x); !heights.empty())
            ground = std::max(ground, heights.back());
    return ground;
}

Depth deepest_below(const Polygon& polygon, const std::vector<Vec2>& line, Level level) {
    Depth deepest{-infinity, Vec2::Zero()};
    const auto look = [&](const Vec2& place) {
        const double below = level(line, place.x()) - place.y();
        if (below > deepest.below) deepest = {below, place};
    };
    // Both are linear between the polygon's vertices and the line's points.
    for (const Side& side : sides_of(polygon)) {
        look(side.a);
        const auto [left, right] = std::minmax(side.a.x(), side.b.x());
        for (const Vec2& kink : line)
            if (kink.x() > left && kink.x() < right)
                look({kink.x(), on_straight(side.a, side.b, kink.x())});
    }
    return deepest;
}

Depth deepest_below(const Outlines& outlines, const std::vector<Vec2>& line, Level level) {
    Depth deepest{-infinity, Vec2::Zero()};
    for (const Polygon* each : outlines)
        if (const Depth here = deepest_below(*each, line, level); here.below > deepest.below)
            deepest = here;
    return deepest;
}

std::vector<double> abscissae(const Outlines& outlines) {
    std::vector<double> xs;
    for (const Polygon* each : outlines)
        for (const Vec2& vertex : *each) xs.push_back(vertex.x());
    if (xs.empty()) return xs;
    std::ranges::sort(xs);
    const double same = same_share * (xs.back() - xs.front());
    const auto repeated =
        std::ranges::unique(xs, [&](double a, double b) { return b - a <= same; });
    xs.erase(repeated.begin(), repeated.end());
    return xs;
}

Levels ground_over(const Outlines& outlines, double from, double to) {
    const Box box = extent(outlines);
    const double near = 1e-6 * (box.high.x() - box.low.x());
    std::vector<double> xs = abscissae(outlines);
    xs.push_back(from);
    xs.push_back(to);
    Levels levels{infinity, -infinity};
    for (const double at : xs) {
        if (at < from || at > to) continue;
        for (const double x : {at - near, at + near}) {  // top and bottom of a vertical face
            const double ground = ground_at(outlines, x);
            if (ground == -infinity) continue;
            levels.lowest = std::min(levels.lowest, ground);
            levels.highest = std::max(levels.highest, ground);
        }
    }
    return levels;
}

std::vector<std::vector<Vec2>> ground_between(const Outlines& outlines, double from, double to) {
    std::vector<std::vector<Vec2>> pieces;
    std::vector<double> xs = abscissae(outlines);
    if (xs.empty()) return pieces;
    const double near = same_share * (xs.back() - xs.front());
    for (double& x : xs) x = std::clamp(x, from, to);
    for (std::size_t i = 0; i + 1 < xs.size(); ++i) {
        if (xs[i + 1] - xs[i] <= near) continue;
        const auto top = top_side(outlines, 0.5 * (xs[i] + xs[i + 1]));
        if (!top) continue;
        const Vec2 a(xs[i], level_on(*top, xs[i]));
        const Vec2 b(xs[i + 1], level_on(*top, xs[i + 1]));
        if (pieces.empty() || (pieces.back().back() - a).norm() > near) pieces.push_back({a});
        pieces.back().push_back(b);
    }
    return pieces;
}

}  // namespace breach::geometry
