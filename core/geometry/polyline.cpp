#include "core/geometry/polyline.hpp"

#include <cmath>

namespace breach::geometry {

using mechanics::Vec2;

std::optional<Crossing> crossing(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
    const Vec2 first = b - a, second = d - c;
    const double turn = cross(first, second);
    if (turn == 0.0) return std::nullopt;
    const double s = cross(c - a, second) / turn, t = cross(c - a, first) / turn;
    return Crossing{a + s * first, s, t};
}

double on_straight(const Vec2& a, const Vec2& b, double x) {
    return a.y() + (b.y() - a.y()) * (x - a.x()) / (b.x() - a.x());
}

double level_at(const std::vector<Vec2>& line, double x) {
    if (x <= line.front().x()) return line.front().y();
    for (std::size_t i = 1; i < line.size(); ++i)
        if (x <= line[i].x()) return on_straight(line[i - 1], line[i], x);
    return line.back().y();
}

double straight_level_at(const std::vector<Vec2>& line, double x) {
    if (line.size() == 1) return line.front().y();
    std::size_t i = 1;
    while (i + 1 < line.size() && x > line[i].x()) ++i;
    return on_straight(line[i - 1], line[i], x);
}

double share_steeper_than(double slope, const std::vector<Vec2>& line) {
    if (line.size() < 2) return 0.0;
    double steep = 0.0;
    for (std::size_t i = 1; i < line.size(); ++i) {
        const Vec2 part = line[i] - line[i - 1];
        if (std::abs(part.y()) > slope * part.x()) steep += part.x();
    }
    return steep / (line.back().x() - line.front().x());
}

}  // namespace breach::geometry
