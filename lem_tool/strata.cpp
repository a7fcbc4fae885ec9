// Every place where a line has a kink or meets another one becomes a border of strips. That makes
// many strips, once; each question of the search is then one about straight lines.
#include "lem_tool/strata.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "core/geometry/polyline.hpp"

namespace breach::lem {

namespace {

/// Vertices closer than this (over the width) coincide; gaps thinner than gap_share of the height
/// are inaccuracies of the drawing and belong to the layer above.
constexpr double same_place = 1e-9;
constexpr double gap_share = 1e-3;

struct Extent {
    double width;
    double height;
};

using Path = std::vector<scene::Vec2>;

void add_crossings(const Path& one, const Path& other, std::vector<double>& xs) {
    for (std::size_t i = 0; i + 1 < one.size(); ++i) {
        for (std::size_t j = 0; j + 1 < other.size(); ++j) {
            // Where two lines cross, one passes from above to below the other: both strips beside
            // it are simple.
            const auto cross = geometry::crossing(one[i], one[i + 1], other[j], other[j + 1]);
            if (!cross) continue;
            const double s = cross->on_first, t = cross->on_second;
            if (s >= 0.0 && s <= 1.0 && t >= 0.0 && t <= 1.0) xs.push_back(cross->at.x());
        }
    }
}

/// A line extended horizontally to both sides of the model.
Path prolonged(Path line, double from, double to) {
    if (line.front().x() > from) line.insert(line.begin(), {from, line.front().y()});
    if (line.back().x() < to) line.emplace_back(to, line.back().y());
    return line;
}

/// Points of a line and its intersections with borders of regions, the ground included.
std::vector<double> breaks_of(const Path& line, const scene::Section& section) {
    std::vector<double> xs;
    for (const scene::Vec2& vertex : line) xs.push_back(vertex.x());
    for (const scene::Region& region : section.regions) {
        Path ring = region.polygon;
        ring.push_back(ring.front());
        add_crossings(ring, line, xs);
    }
    return xs;
}

/// All phreatic lines, from side to side.
std::vector<Path> water_paths(const scene::Lem& lem, double from, double to) {
    std::vector<Path> paths;
    if (lem.water) paths.push_back(prolonged(lem.water->line, from, to));
    for (const scene::Water& each : lem.piezometric_lines)
        paths.push_back(prolonged(each.line, from, to));
    return paths;
}

/// Abscissae between which all lines are straight.
std::vector<double> strip_borders(const scene::Scene& scene, Extent& extent) {
    const scene::Section& section = scene.section;
    const scene::Lem& lem = scene::lem_of(scene);
    std::vector<double> xs;
    for (const scene::Region& region : section.regions)
        for (const scene::Vec2& vertex : region.polygon) xs.push_back(vertex.x());
    const geometry::Box box = geometry::extent(section);
    const double from = box.low.x(), to = box.high.x();
    const auto add = [&](double x) {
        if (x > from && x < to) xs.push_back(x);
    };
    extent = {to - from, box.high.y() - box.low.y()};
    const std::vector<Path> waters = water_paths(lem, from, to);
    for (const Path& water : waters) {
        for (const double x : breaks_of(water, section)) add(x);
    }
    if (!lem.floor.empty()) {
        const Path floor = prolonged(lem.floor, from, to);
        std::vector<double> breaks = breaks_of(floor, section);
        for (const Path& water : waters) add_crossings(floor, water, breaks);
        for (const double x : breaks) add(x);
    }
    for (const scene::Surcharge& load : lem.surcharge) {
        add(load.from);
        add(load.to);
    }
    if (lem.tension_crack && lem.tension_crack->level) {
        const double level = *lem.tension_crack->level;
        for (const double x : breaks_of({{from, level}, {to, level}}, section)) add(x);
    }
    if (lem.search && lem.search->lowest_level) {
        const double level = *lem.search->lowest_level;
        for (const double x : breaks_of({{from, level}, {to, level}}, section)) add(x);
    }
    std::sort(xs.begin(), xs.end());
    const double tolerance = same_place * extent.width;
    xs.erase(
        std::unique(xs.begin(), xs.end(), [&](double a, double b) { return b - a <= tolerance; }),
        xs.end());
    return xs;
}

/// The part of one region in a strip.
struct Piece {
    Line top;
    Line bottom;
    std::size_t region;
};

Line line_through(const scene::Vec2& a, const scene::Vec2& b) {
    const double slope = (b.y() - a.y()) / (b.x() - a.x());
    return {a.y() - slope * a.x(), slope};
}

void add_pieces(const geometry::Polygon& polygon, std::size_t region, double from, double to,
                double tolerance, std::vector<Piece>& pieces) {
    const double middle = 0.5 * (from + to);
    std::vector<Line> lines;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const scene::Vec2& a = polygon[i];
        const scene::Vec2& b = polygon[(i + 1) % polygon.size()];
        // Edges that span the strip; by its making none ends inside it.
        if (std::min(a.x(), b.x()) <= from + tolerance &&
            std::max(a.x(), b.x()) >= to - tolerance) {
            lines.push_back(line_through(a, b));
        }
    }
    std::sort(lines.begin(), lines.end(),
              [&](const Line& p, const Line& q) { return p.at(middle) > q.at(middle); });
    // Upper and lower border in turn: a region may have several pieces in a strip.
    for (std::size_t i = 0; i + 1 < lines.size(); i += 2) {
        pieces.push_back({lines[i], lines[i + 1], region});
    }
}

constexpr Line nowhere{-std::numeric_limits<double>::infinity(), 0.0};

/// The straight piece of a line at x = middle; level beyond its ends.
Line part_over(const Path& line, double middle) {
    if (line.empty()) return nowhere;
    if (middle <= line.front().x()) return {line.front().y(), 0.0};
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        if (middle < line[i + 1].x()) return line_through(line[i], line[i + 1]);
    }
    return {line.back().y(), 0.0};
}

Line water_over(const scene::Lem& lem, double middle) {
    return lem.water ? part_over(lem.water->line, middle) : nowhere;
}

/// cos^2 of the line's inclination, if requested, applies to the depth below the line or the
/// ground, whichever is lower: a line on the ground (seepage face) is corrected in spite of
/// round-off. Above ground it is free water.
PorePressure pressure_below(const Line& line, const Line& ground, double gamma_w, double middle,
                            scene::PhreaticCorrection correction) {
    const bool corrected = correction == scene::PhreaticCorrection::cos2;
    const double gamma = corrected ? gamma_w / (1.0 + line.slope * line.slope) : gamma_w;
    if (line.at(middle) <= ground.at(middle)) return {line, {0.0, 0.0}, gamma};
    return {ground,
            {gamma_w * (line.level - ground.level), gamma_w * (line.slope - ground.slope)},
            gamma};
}

/// One per phreatic line of the scene. A piezometric line has no free water: hydrostatic from its
/// level down.
void add_pressures(const scene::Scene& scene, const Line& ground, double middle, Strata& strata) {
    const scene::Lem& lem = scene::lem_of(scene);
    const auto add = [&](const scene::Water& water, bool stands_free) {
        const Line line = part_over(water.line, middle);
        strata.pressures.push_back(pressure_below(line, stands_free ? ground : line,
                                                  water.density * scene.gravity, middle,
                                                  water.correction));
    };
    if (lem.water) add(*lem.water, true);
    for (const scene::Water& each : lem.piezometric_lines) add(each, false);
}

double surcharge_on(const scene::Lem& lem, double middle) {
    double pressure = 0.0;
    for (const scene::Surcharge& load : lem.surcharge) {
        if (middle > load.from && middle < load.to) pressure += load.pressure;
    }
    return pressure;
}

[[noreturn]] void refuse_gap(const scene::Scene& scene, double x, const std::string& what) {
    throw fault::BadInput(
        scene.name,
        {{"/section/regions", "leaves " + what + " at x = " + std::to_string(x) + " m",
          "limit equilibrium cuts vertical slices: give regions that touch from the ground to the "
          "bottom of the model, without overhang"}});
}

/// Load of a piece that has not consolidated the soil below: its weight minus the pressure of its
/// water, which acts as before. `lower`: lower border of the piece.
void add_effective(const Piece& piece, const Line& lower, double gamma, const PorePressure* water,
                   double middle, Line& sum) {
    const auto add = [&](const Line& top, double per_metre) {
        sum.level += per_metre * (top.level - lower.level);
        sum.slope += per_metre * (top.slope - lower.slope);
    };
    add(piece.top, gamma);
    if (!water || water->top.at(middle) <= lower.at(middle)) return;
    add(water->top.at(middle) < piece.top.at(middle) ? water->top : piece.top, -water->gamma);
}

void add_strip(const scene::Scene& scene, const std::vector<std::optional<std::size_t>>& lines,
               double from, double to, const Extent& extent, Strata& strata) {
    const double middle = 0.5 * (from + to);
    std::vector<Piece> pieces;
    for (std::size_t i = 0; i < scene.section.regions.size(); ++i) {
        add_pieces(scene.section.regions[i].polygon, i, from, to, same_place * extent.width,
                   pieces);
    }
    if (pieces.empty()) refuse_gap(scene, middle, "nothing");
    std::stable_sort(pieces.begin(), pieces.end(), [&](const Piece& p, const Piece& q) {
        return p.top.at(middle) > q.top.at(middle);
    });
    const scene::Lem& lem = scene::lem_of(scene);
    Line bottom = pieces.back().bottom;
    if (lem.search && lem.search->lowest_level && *lem.search->lowest_level > bottom.at(middle)) {
        bottom = {*lem.search->lowest_level, 0.0};
    }
    Strip strip{from,
                to,
                strata.layers.size(),
                0,
                bottom,
                part_over(lem.floor, middle),
                water_over(lem, middle),
                surcharge_on(lem, middle),
                strata.pressures.size()};
    add_pressures(scene, pieces.front().top, middle, strata);
    Line weight{0.0, 0.0}, fast{0.0, 0.0};
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const Piece& piece = pieces[i];
        if (i > 0) {
            const double gap = pieces[i - 1].bottom.at(middle) - piece.top.at(middle);
            // No overlaps (negative gaps): reading the scene refuses them (read_section.cpp).
            if (gap > gap_share * extent.height) refuse_gap(scene, middle, "air below ground");
        }
        const scene::Material& soil = scene.material_of(piece.region);
        const double gamma = soil.density * scene.gravity;
        strata.layers.push_back({piece.top, piece.region, gamma, weight, fast});
        // The next layer's top, not this one's bottom: thin gaps of the drawing are filled.
        const Line& lower = i + 1 < pieces.size() ? pieces[i + 1].top : piece.bottom;
        weight.level += gamma * (piece.top.level - lower.level);
        weight.slope += gamma * (piece.top.slope - lower.slope);
        if (std::ranges::count(lem.unconsolidated, piece.region) == 0) continue;
        const auto line = lines[piece.region];
        add_effective(piece, lower, gamma,
                      line ? &strata.pressures[strip.pressures + *line] : nullptr, middle, fast);
    }
    strip.last = strata.layers.size();
    strata.strips.push_back(strip);
}

/// Adds free water on the vertical faces of the ground.
void add_pushes(const Extent& extent, Strata& strata) {
    const double same_level = same_place * (extent.width + extent.height);
    for (std::size_t i = 0; strata.gamma_w > 0.0 && i + 1 < strata.strips.size(); ++i) {
        const double x = strata.strips[i].to;
        const double left = strata.ground(strata.strips[i]).at(x);
        const double right = strata.ground(strata.strips[i + 1]).at(x);
        if (std::abs(right - left) <= same_level) continue;
        // Water stands on the lower side of the face.
        const bool faces_left = right > left;
        const double water = strata.strips[faces_left ? i : i + 1].water.at(x);
        const Thrust push =
            thrust(strata.gamma_w, water, std::min(left, right), std::max(left, right));
        if (push.force > 0.0) {
            strata.pushes.push_back({x, push.level, faces_left ? -push.force : push.force});
        }
    }
}

Crack crack_of(const scene::Scene& scene) {
    const scene::Lem& lem = scene::lem_of(scene);
    if (!lem.tension_crack) return {};
    const auto& [depth, level, filled] = *lem.tension_crack;
    const double gamma_w = (lem.water ? lem.water->density : 1000.0) * scene.gravity;
    if (depth) return {Crack::Reach::depth, *depth, 1.0, filled, gamma_w};
    return {Crack::Reach::level, *level, 1.0, filled, gamma_w};
}

}  // namespace

Line Strata::crack_foot(const Strip& strip) const {
    const Line& top = ground(strip);
    const auto below = [&](const Line& foot) {
        return Line{top.level + crack.share * (foot.level - top.level),
                    top.slope + crack.share * (foot.slope - top.slope)};
    };
    if (crack.reach == Crack::Reach::none) return top;
    if (crack.reach == Crack::Reach::depth) return below({top.level - crack.foot, top.slope});
    // Strips end where the level crosses the ground: one of the two is lower everywhere.
    return top.at(0.5 * (strip.from + strip.to)) > crack.foot ? below({crack.foot, 0.0}) : top;
}

Thrust thrust(double gamma_w, double water, double low, double high) {
    if (!(water > low) || !(high > low)) return {0.0, low};
    const double deep = water - low;
    const double shallow = std::max(0.0, water - high);
    const double force = 0.5 * gamma_w * (deep * deep - shallow * shallow);
    // Pressure-weighted depth: (2/3) (b^3 - a^3) / (b^2 - a^2)
    const double depth =
        (2.0 / 3.0) * (deep * deep + deep * shallow + shallow * shallow) / (deep + shallow);
    return {force, water - depth};
}

std::vector<std::optional<std::size_t>> lines_of_regions(const scene::Scene& scene) {
    const scene::Lem& lem = scene::lem_of(scene);
    std::vector<std::optional<std::size_t>> lines(scene.section.regions.size());
    std::size_t line = 0;
    const auto give = [&](const scene::Water& water) {
        for (const std::size_t region : water.regions) lines[region] = line;
        ++line;
    };
    // /lem/water is the line of all regions unless it names some; piezometric lines overwrite it.
    if (lem.water && lem.water->regions.empty()) std::ranges::fill(lines, line);
    if (lem.water) give(*lem.water);
    for (const scene::Water& each : lem.piezometric_lines) give(each);
    return lines;
}

Strata make_strata(const scene::Scene& scene) {
    Extent extent{};
    const std::vector<double> borders = strip_borders(scene, extent);
    Strata strata;
    const scene::Lem& lem = scene::lem_of(scene);
    if (lem.water) strata.gamma_w = lem.water->density * scene.gravity;
    strata.lines = (lem.water ? 1 : 0) + lem.piezometric_lines.size();
    const auto lines = lines_of_regions(scene);
    for (std::size_t i = 0; i + 1 < borders.size(); ++i) {
        add_strip(scene, lines, borders[i], borders[i + 1], extent, strata);
    }
    strata.crack = crack_of(scene);
    add_pushes(extent, strata);
    return strata;
}

std::size_t strip_at(const Strata& strata, double x) {
    const auto found =
        std::lower_bound(strata.strips.begin(), strata.strips.end() - 1, x,
                         [](const Strip& strip, double at) { return strip.to < at; });
    return static_cast<std::size_t>(found - strata.strips.begin());
}

double ground_level(const Strata& strata, double x, From from) {
    std::size_t i = strip_at(strata, x);
    const bool on_border = x >= strata.strips[i].to && i + 1 < strata.strips.size();
    if (on_border && from == From::right) ++i;
    return strata.ground(strata.strips[i]).at(x);
}

}  // namespace breach::lem
