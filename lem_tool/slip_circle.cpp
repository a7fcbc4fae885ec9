#include "lem_tool/slip_circle.hpp"

#include <algorithm>
#include <cmath>

namespace breach::lem {

namespace {

/// Abscissae between which (ground - arc) does not change sign.
std::vector<double> sign_borders(const Strata& strata, const scene::Circle& circle) {
    const double from = std::max(strata.left(), circle.center.x() - circle.radius);
    const double to = std::min(strata.right(), circle.center.x() + circle.radius);
    std::vector<double> borders{from, to};
    for (const Strip& strip : strata.strips) {
        const double low = std::max(from, strip.from);
        const double high = std::min(to, strip.to);
        if (low >= high) continue;
        borders.push_back(low);
        const Meeting meeting = meet(circle, strata.ground(strip), low, high);
        borders.insert(borders.end(), meeting.x, meeting.x + meeting.count);
    }
    std::sort(borders.begin(), borders.end());
    return borders;
}

}  // namespace

std::vector<Surface> masses_of(const Strata& strata, const scene::Circle& circle) {
    std::vector<Surface> whole;
    const std::vector<double> borders = sign_borders(strata, circle);
    bool inside = false;
    for (std::size_t i = 0; i + 1 < borders.size(); ++i) {
        if (borders[i + 1] <= borders[i]) continue;
        // One look in the middle decides: between borders the sign does not change.
        const double middle = 0.5 * (borders[i] + borders[i + 1]);
        const bool below = base_level(strata, {circle, 0.0, 0.0}, middle) <
                           ground_level(strata, middle, From::left);
        if (below && inside) whole.back().right = borders[i + 1];
        if (below && !inside) whole.push_back({circle, borders[i], borders[i + 1]});
        inside = below;
    }
    std::vector<Surface> masses;
    for (const Surface& surface : whole) {
        const bool falls_left =
            base_level(strata, surface, surface.left) < base_level(strata, surface, surface.right);
        const auto cracked =
            with_crack(strata, surface, falls_left ? UpperEnd::right : UpperEnd::left);
        if (cracked) masses.push_back(*cracked);
    }
    return masses;
}

double base_level(const Strata& strata, const Surface& surface, double x) {
    return std::max(surface.level(x), strata.strips[strip_at(strata, x)].floor.at(x));
}

std::optional<Surface> with_crack(const Strata& strata, const Surface& surface, UpperEnd upper) {
    if (strata.crack.reach == Crack::Reach::none) return surface;
    const bool from_left = upper == UpperEnd::left;
    std::size_t i = strip_at(strata, from_left ? surface.left : surface.right);
    while (true) {
        const Strip& strip = strata.strips[i];
        const double low = std::max(strip.from, surface.left);
        const double high = std::min(strip.to, surface.right);
        const Line feet = strata.crack_foot(strip);
        const double start = from_left ? low : high;
        // A crack that does not reach below the ground at the upper end cuts nothing off.
        const bool at_end = start == (from_left ? surface.left : surface.right);
        if (at_end && high > low && feet.at(start) >= strata.ground(strip).at(start))
            return surface;
        std::optional<double> found;
        if (high > low && surface.level(start) <= feet.at(start)) found = start;
        const Meeting meeting = meet(surface.circle, feet, low, high);
        if (!found && meeting.count > 0) found = meeting.x[from_left ? 0 : meeting.count - 1];
        if (found && from_left)
            return Surface{surface.circle, *found, surface.right, CrackAt::left};
        if (found) return Surface{surface.circle, surface.left, *found, CrackAt::right};
        if (from_left ? strip.to >= surface.right || i + 1 == strata.strips.size()
                      : strip.from <= surface.left || i == 0) {
            return std::nullopt;
        }
        i += from_left ? 1 : -1;
    }
}

double Ends::largest_sagitta() const {
    const scene::Vec2 chord = right - left;
    const double L = half_chord();
    // The centre is (L^2 - s^2) / 2s above the chord's middle, along its normal.
    const double rise = 0.5 * std::abs(chord.y()) * chord.norm() / chord.x();
    return std::sqrt(rise * rise + L * L) - rise;
}

Surface surface_through(const Ends& ends, double sagitta) {
    const scene::Vec2 chord = ends.right - ends.left;
    const double L = ends.half_chord();
    const scene::Vec2 up = scene::Vec2(-chord.y(), chord.x()) / (2.0 * L);
    // Height of the centre over the chord's middle; negative for more than half a circle.
    const double above = (L * L - sagitta * sagitta) / (2.0 * sagitta);
    const double R = (L * L + sagitta * sagitta) / (2.0 * sagitta);
    return {{0.5 * (ends.left + ends.right) + above * up, R}, ends.left.x(), ends.right.x()};
}

Touching touching(const Ends& ends, const Line& line) {
    Touching result;
    const scene::Vec2 chord = ends.right - ends.left;
    const double L = ends.half_chord();
    const scene::Vec2 up = scene::Vec2(-chord.y(), chord.x()) / (2.0 * L);
    const scene::Vec2 normal = scene::Vec2(-line.slope, 1.0) / std::hypot(1.0, line.slope);
    const scene::Vec2 middle = 0.5 * (ends.left + ends.right);
    // Distance of the centre from the line = R:  (1 + B) s^2 - 2 A s + (1 - B) L^2 = 0
    const double A = normal.dot(middle - scene::Vec2(0.0, line.level));
    const double B = normal.dot(up);
    const double discriminant = A * A - (1.0 - B * B) * L * L;
    if (discriminant < 0.0 || A <= 0.0) return result;
    const double root = std::sqrt(discriminant);
    const double largest = ends.largest_sagitta();
    for (const double s : {(A - root) / (1.0 + B), (A + root) / (1.0 + B)}) {
        if (s > 0.0 && s <= largest) result.sagitta[result.count++] = s;
    }
    return result;
}

}  // namespace breach::lem
