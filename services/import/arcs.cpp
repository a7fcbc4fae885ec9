// Arcs as DXF stores them: bulge = tan(a quarter of the angle), positive to the left. A bulge
// cannot hold a full circle, so arcs are cut in two halves.
#include "services/import/arcs.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace breach::importing {

std::vector<Corner> corners_of_arc(const Vec2& centre, double radius, double from, double angle) {
    const auto on_circle = [&](double at) {
        return Vec2(centre + radius * Vec2(std::cos(at), std::sin(at)));
    };
    const double bulge = std::tan(0.125 * angle);
    return {{on_circle(from), 0.0, bulge},
            {on_circle(from + 0.5 * angle), 0.0, bulge},
            {on_circle(from + angle)}};
}

/// Two chords at least: one alone would be the straight side.
std::vector<Vec2> points_on_arc(const Vec2& from, const Vec2& to, double bulge, double sagitta) {
    const Vec2 chord = to - from;
    const double length = chord.norm();
    if (length == 0.0 || bulge == 0.0) return {};
    const double angle = 4.0 * std::atan(bulge);
    const double radius = 0.25 * length * (bulge + 1.0 / bulge);  // with the sign of the bulge
    const Vec2 left(-chord.y() / length, chord.x() / length);
    const Vec2 centre = from + 0.5 * chord + left * (0.25 * length * (1.0 / bulge - bulge));
    // More than a radius off is no arc any more: acos() would give NaN.
    const double off = std::min(sagitta / std::abs(radius), 1.0);
    // The chord that is at most `sagitta` from the arc: sagitta = r (1 - cos(step / 2)).
    const double step = 2.0 * std::acos(1.0 - off);
    const double wanted = step > 0.0 ? std::ceil(std::abs(angle) / step) : 512.0;
    // At most 512, so that a tiny tolerance cannot make millions of points.
    const int chords = static_cast<int>(std::clamp(wanted, 2.0, 512.0));
    std::vector<Vec2> points;
    const Vec2 spoke = from - centre;
    for (int i = 1; i < chords; ++i) {
        const double turned = angle * i / chords;
        const double c = std::cos(turned), s = std::sin(turned);
        points.push_back(centre +
                         Vec2(c * spoke.x() - s * spoke.y(), s * spoke.x() + c * spoke.y()));
    }
    return points;
}

}  // namespace breach::importing
