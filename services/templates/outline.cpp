#include "services/templates/outline.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/polyline.hpp"

namespace breach::templates {

Line drained_line(const Vec2& from, double exit, double left, double right, const Line& ground) {
    constexpr int pieces = 8;
    const double span = exit - from.x();
    std::vector<double> xs;
    for (int i = 1; i < pieces; ++i) {
        const double share = 1.0 - static_cast<double>(i) / pieces;  // of the height that is left
        xs.push_back(exit - span * share * share);
    }
    for (const Vec2& kink : ground)
        if (kink.x() > from.x() && kink.x() < exit) xs.push_back(kink.x());
    std::ranges::sort(xs);
    const double same = 0.005 * span;
    Line line{{left, from.y()}, from};
    for (const double x : xs) {
        if (x - line.back().x() < same || exit - x < same) continue;
        const double level = from.y() * std::sqrt((exit - x) / span);
        line.push_back({x, std::min(level, geometry::level_at(ground, x))});
    }
    line.push_back({exit, 0.0});
    if (right > exit + same) line.push_back({right, 0.0});
    if (from.x() - left < same) line.erase(line.begin());
    line.front().x() = left;
    return line;
}

}  // namespace breach::templates
