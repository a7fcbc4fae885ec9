// What a drawing does not say, guessed from the line of the ground. Real sections have berms, a
// pond on the crest, a second face upstream and ground that keeps falling beyond the toe: hence
// shares of the fall as limits instead of the extreme points. Called by document.cpp for every
// import, by shake.cpp for the terrain, by steps.cpp and section_scene.cpp for checks of size and
// shape. A wrong guess is shown in the report, and the user corrects it in the scene.
#include "services/import/guess.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry/polyline.hpp"
#include "core/words/number.hpp"

namespace breach::importing {

namespace {

Vec2 mirrored(const Vec2& place) { return {-place.x(), place.y()}; }

std::vector<Vec2> mirrored(std::vector<Vec2> line) {
    for (Vec2& each : line) each = mirrored(each);
    std::ranges::reverse(line);
    return line;
}

/// Whether the ground beyond this place is not part of the face: it falls less than a third as
/// steeply as from the crest to here. Ignores falls shorter than `near`.
bool is_gentle_beyond(const std::vector<Vec2>& ground, std::size_t crest, std::size_t at,
                      double near) {
    const Vec2 fall = ground[at] - ground[crest];
    const double gentle = -fall.y() / std::max(fall.x(), near) / 3.0;
    for (std::size_t i = at + 1; i < ground.size(); ++i) {
        const Vec2 beyond = ground[i] - ground[at];
        if (-beyond.y() > near && -beyond.y() >= gentle * beyond.x()) return false;
    }
    return true;
}

/// Crest: the last place nearly as high as the highest. Toe: the first place right of it, below
/// half of the fall, where the face ends.
/// The last high place, as a slip enters near the face. 5 % of the fall: a camber or a road on the
/// crest is no slope.
Slope falling_right(const std::vector<Vec2>& ground) {
    const auto y = [](const Vec2& each) { return each.y(); };
    const double highest = std::ranges::max(ground, {}, y).y();
    const double lowest = std::ranges::min(ground, {}, y).y();
    const double near = 0.05 * (highest - lowest);
    std::size_t crest = 0;
    for (std::size_t i = 0; i < ground.size(); ++i)
        if (ground[i].y() >= highest - near) crest = i;
    double foot = ground[crest].y();
    for (std::size_t i = crest; i < ground.size(); ++i) foot = std::min(foot, ground[i].y());
    const double half = 0.5 * (ground[crest].y() + foot);
    std::size_t toe = crest;
    while (ground[toe].y() > half || !is_gentle_beyond(ground, crest, toe, near)) ++toe;
    return {ground[crest], ground[toe]};
}

/// To three digits of the section's length: a guess has no millimetres.
double rounded(double x, double length) {
    const double step = std::pow(10.0, std::floor(std::log10(length)) - 2.0);
    return std::round(x / step) * step;
}

std::vector<Soil> turned(std::vector<Soil> soils) {
    for (Soil& each : soils)
        for (Vec2& place : each.ring) place.y() = -place.y();
    return soils;
}

/// Without the points that lie within `off` of the straight line between those kept.
std::vector<Vec2> cornered(const std::vector<Vec2>& line, double off) {
    std::vector<Vec2> corners;
    std::size_t from = 0;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const bool is_end = i == 0 || i + 1 == line.size();
        const auto strays = [&](const Vec2& each) {
            return geometry::distance_to_segment(each, line[from], line[i + 1]) > off;
        };
        if (!is_end && std::none_of(line.begin() + static_cast<std::ptrdiff_t>(from) + 1,
                                    line.begin() + static_cast<std::ptrdiff_t>(i) + 1, strays))
            continue;
        corners.push_back(line[i]);
        from = i;
    }
    return corners;
}

}  // namespace

geometry::Outlines outlines_of(const std::vector<Soil>& soils) {
    return geometry::outlines_of(soils, &Soil::ring);
}

geometry::Box box_of(const std::vector<Soil>& soils) {
    return geometry::extent(outlines_of(soils));
}

/// Pieces in one line: stretches without soil are straight between their ends. A border that
/// reaches the face from inside is no corner of the ground: a crest would move to it.
std::vector<Vec2> ground_of(const std::vector<Soil>& soils) {
    constexpr double everywhere = std::numeric_limits<double>::infinity();
    constexpr double straight = 1e-3;  // m
    std::vector<Vec2> ground;
    for (const auto& piece : geometry::ground_between(outlines_of(soils), -everywhere, everywhere))
        ground.insert(ground.end(), piece.begin(), piece.end());
    return cornered(ground, straight);
}

/// Beyond what is drawn the ground goes on falling as it does from the toe on, because level ground
/// would stop the soil too early. A rise stops it, so it ends where the drawing does.
Terrain guessed_terrain(const std::vector<Soil>& soils, const std::vector<Vec2>& drawn) {
    constexpr double heights = 10.0;  // beyond the toe, as in "breach new"
    constexpr double steepest = 0.2;
    std::vector<Vec2> ground = ground_of(soils);
    const Slope slope = *slope_of(ground);
    const geometry::Box box = box_of(soils);
    const double h = element_size_for(slope.fall()), end = box.high.x();
    std::vector<Vec2> base = ground_of(turned(soils));
    for (Vec2& each : base) each.y() = -each.y();
    std::string from = "no terrain is drawn: the section's lower edge, then ";
    const bool is_drawn = !drawn.empty() && drawn.back().x() > end + h;
    if (is_drawn) {
        ground.emplace_back(end + 0.4 * h, geometry::level_at(drawn, end + 0.4 * h));
        for (const Vec2& each : drawn)
            if (each.x() > end + 0.4 * h) ground.push_back(each);
        from += "the drawn ground line, and beyond it ground ";
    } else {
        ground.emplace_back(end + 0.4 * h, ground.back().y());
        from += "from its right end on ground ";
    }
    const Vec2 beyond = ground.back() - slope.toe;
    const double fall =
        beyond.x() < slope.fall() ? 0.0 : std::clamp(-beyond.y() / beyond.x(), 0.0, steepest);
    from += fall > 0.0 ? "that goes on falling by " + words::text_of(100.0 * fall, 2) +
                             " %, as it does from the toe on"
                       : "at the level there";
    std::vector<Vec2> line = base;
    line.emplace_back(end + 0.2 * h, base.back().y());
    const auto natural =
        std::ranges::find_if(ground, [&](const Vec2& each) { return each.x() > end + 0.3 * h; });
    line.insert(line.end(), natural, ground.end());
    const double right = std::max(slope.toe.x() + heights * slope.fall(), end + 4.0 * h);
    const Vec2 last = line.back();
    if (right > last.x()) line.emplace_back(right, last.y() - fall * (right - last.x()));
    return {cornered(line, 1e-6), from};
}

/// Between all neighbouring corners, in the middle: there the order of the strata is the same
/// along the whole strip.
std::optional<Void> highest_void(const std::vector<Soil>& soils, double tolerance) {
    const geometry::Outlines outlines = outlines_of(soils);
    const std::vector<double> xs = geometry::abscissae(outlines);
    std::optional<Void> highest;
    for (std::size_t i = 0; i + 1 < xs.size(); ++i) {
        const double x = 0.5 * (xs[i] + xs[i + 1]);
        const std::vector<geometry::Stratum> strata = geometry::strata_at(outlines, x);
        for (std::size_t k = strata.size(); k > 1; --k) {
            const geometry::Stratum &above = strata[k - 2], &below = strata[k - 1];
            const double height = above.bottom - below.top;
            if (height <= (highest ? highest->height : tolerance)) continue;
            const Vec2 at(x, 0.5 * (above.bottom + below.top));
            highest = {at, height, above.region, below.region};
        }
    }
    return highest;
}

/// Turned upside down, the section would have a slope that it has not as drawn.
bool looks_upside_down(const std::vector<Soil>& soils) {
    if (slope_of(ground_of(soils))) return false;
    const auto slope = slope_of(ground_of(turned(soils)));
    constexpr double face = 0.1;  // flatter bases are not the face of a dam
    return slope && slope->fall() > face * std::abs(slope->toe.x() - slope->crest.x());
}

/// A dam has two faces of nearly one height: then the steeper one is meant; else the higher one.
std::optional<Slope> slope_of(const std::vector<Vec2>& ground) {
    if (ground.size() < 2) return std::nullopt;
    const Slope right = falling_right(ground);
    Slope left = falling_right(mirrored(ground));
    left = {mirrored(left.crest), mirrored(left.toe)};
    const auto steepness = [](const Slope& slope) {
        return slope.fall() / std::max(std::abs(slope.toe.x() - slope.crest.x()), 1e-3);
    };
    const bool alike = std::abs(right.fall() - left.fall()) < 0.1 * right.fall();
    const bool rightwards =
        alike ? steepness(right) >= steepness(left) : right.fall() > left.fall();
    const Slope slope = rightwards ? right : left;
    if (slope.fall() < 0.01 * (ground.back().x() - ground.front().x())) return std::nullopt;
    return slope;
}

/// Both ranges keep a small distance from the section's ends, before they are rounded.
Ranges ranges_of(const Slope& slope, const std::vector<Vec2>& ground) {
    const double length = std::abs(slope.toe.x() - slope.crest.x());
    const double way = slope.toe.x() > slope.crest.x() ? 1.0 : -1.0;
    const double left = ground.front().x(), right = ground.back().x();
    const double inset = 0.002 * (right - left);
    const auto x = [&](double from, double by) {
        const double at = std::clamp(from + way * by, left + inset, right - inset);
        return std::clamp(rounded(at, right - left), left, right);
    };
    const double behind = std::max(length, 2.0 * slope.fall());
    std::array<double, 2> entry{x(slope.crest.x(), -behind), x(slope.crest.x(), 0.25 * length)};
    std::array<double, 2> exit{x(slope.crest.x(), 0.5 * length), x(slope.toe.x(), slope.fall())};
    std::ranges::sort(entry);
    std::ranges::sort(exit);
    return {entry, exit};
}

/// Round numbers, as a user would choose them.
double element_size_for(double height) {
    const double wanted = std::max(height, 0.01) / 15.0;
    const double power = std::pow(10.0, std::floor(std::log10(wanted)));
    const double share = wanted / power;
    return power * (share < 1.5 ? 1.0 : share < 3.5 ? 2.0 : share < 7.5 ? 5.0 : 10.0);
}

/// Down: a larger cell would leave fewer than twenty over the height.
double cell_size_for(double height) {
    const double most = std::max(height, 0.01) / 20.0;
    const double digit = std::pow(10.0, std::floor(std::log10(most)) - 1.0);
    return std::floor(most / digit * (1.0 + 1e-9)) * digit;
}

}  // namespace breach::importing
