#include "lem_tool/strata.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace breach::lem {

namespace {

/// Vertices closer than this (relative to the width) are the same; gaps thinner than gap_share of
/// the height are drawing inaccuracies and belong to the layer above.
constexpr double same_place = 1e-9;
constexpr double gap_share = 1e-3;

struct Extent {
    double width;
    double height;
};

/// Where the water line crosses the border of a region: among them, where free water meets the
/// ground.
std::vector<double> shorelines(const scene::Section& section,
                               const std::vector<scene::Vec2>& water) {
    std::vector<double> xs;
    for (const scene::Region& region : section.regions) {
        for (std::size_t i = 0; i < region.polygon.size(); ++i) {
            const scene::Vec2& a = region.polygon[i];
            const scene::Vec2 ab = region.polygon[(i + 1) % region.polygon.size()] - a;
            for (std::size_t j = 0; j + 1 < water.size(); ++j) {
                const scene::Vec2 cd = water[j + 1] - water[j];
                const scene::Vec2 ac = water[j] - a;
                const double cross = ab.x() * cd.y() - ab.y() * cd.x();
                if (cross == 0.0) continue;
                const double s = (ac.x() * cd.y() - ac.y() * cd.x()) / cross;
                const double t = (ac.x() * ab.y() - ac.y() * ab.x()) / cross;
                if (s >= 0.0 && s <= 1.0 && t >= 0.0 && t <= 1.0) xs.push_back(a.x() + s * ab.x());
            }
        }
    }
    return xs;
}

/// Abscissae between which everything is straight.
std::vector<double> strip_borders(const scene::Scene& scene, Extent& extent) {
    const scene::Section& section = scene.section;
    const scene::Lem& lem = scene::lem_of(scene);
    std::vector<double> xs;
    double low = section.regions.front().polygon.front().y();
    double high = low;
    for (const scene::Region& region : section.regions) {
        for (const scene::Vec2& vertex : region.polygon) {
            xs.push_back(vertex.x());
            low = std::min(low, vertex.y());
            high = std::max(high, vertex.y());
        }
    }
    const auto [left, right] = std::minmax_element(xs.begin(), xs.end());
    const double from = *left;
    const double to = *right;
    const auto add = [&](double x) {
        if (x > from && x < to) xs.push_back(x);
    };
    extent = {to - from, high - low};
    if (lem.water) {
        for (const scene::Vec2& vertex : lem.water->line) add(vertex.x());
        for (const double x : shorelines(section, lem.water->line)) add(x);
    }
    for (const scene::Surcharge& load : lem.surcharge) {
        add(load.from);
        add(load.to);
    }
    std::sort(xs.begin(), xs.end());
    const double tolerance = same_place * extent.width;
    xs.erase(
        std::unique(xs.begin(), xs.end(), [&](double a, double b) { return b - a <= tolerance; }),
        xs.end());
    return xs;
}

/// What one region contributes to a strip.
struct Piece {
    Line top;
    Line bottom;
    std::size_t region;
};

Line line_through(const scene::Vec2& a, const scene::Vec2& b) {
    const double slope = (b.y() - a.y()) / (b.x() - a.x());
    return {a.y() - slope * a.x(), slope};
}

void add_pieces(const scene::Polygon& polygon, std::size_t region, double from, double to,
                double tolerance, std::vector<Piece>& pieces) {
    const double middle = 0.5 * (from + to);
    std::vector<Line> lines;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const scene::Vec2& a = polygon[i];
        const scene::Vec2& b = polygon[(i + 1) % polygon.size()];
        if (std::min(a.x(), b.x()) <= from + tolerance &&
            std::max(a.x(), b.x()) >= to - tolerance) {
            lines.push_back(line_through(a, b));
        }
    }
    std::sort(lines.begin(), lines.end(),
              [&](const Line& p, const Line& q) { return p.at(middle) > q.at(middle); });
    for (std::size_t i = 0; i + 1 < lines.size(); i += 2) {
        pieces.push_back({lines[i], lines[i + 1], region});
    }
}

constexpr Line no_water{-std::numeric_limits<double>::infinity(), 0.0};

/// Level of the water over a strip; the line goes on level beyond its ends.
Line water_over(const scene::Lem& lem, double middle) {
    if (!lem.water) return no_water;
    const std::vector<scene::Vec2>& line = lem.water->line;
    if (middle <= line.front().x()) return {line.front().y(), 0.0};
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        if (middle < line[i + 1].x()) return line_through(line[i], line[i + 1]);
    }
    return {line.back().y(), 0.0};
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

void add_strip(const scene::Scene& scene, double from, double to, const Extent& extent,
               Strata& strata) {
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
    Strip strip{from,
                to,
                strata.layers.size(),
                0,
                pieces.back().bottom,
                water_over(scene::lem_of(scene), middle),
                surcharge_on(scene::lem_of(scene), middle)};
    Line weight{0.0, 0.0};
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const Piece& piece = pieces[i];
        if (i > 0) {
            const double gap = pieces[i - 1].bottom.at(middle) - piece.top.at(middle);
            if (gap > gap_share * extent.height) refuse_gap(scene, middle, "air below ground");
        }
        const scene::Material& soil = scene.materials[scene.section.regions[piece.region].material];
        const double gamma = soil.density * scene.gravity;
        strata.layers.push_back({piece.top, piece.region, gamma, weight});
        const Line& lower = i + 1 < pieces.size() ? pieces[i + 1].top : piece.bottom;
        weight.level += gamma * (piece.top.level - lower.level);
        weight.slope += gamma * (piece.top.slope - lower.slope);
    }
    strip.last = strata.layers.size();
    strata.strips.push_back(strip);
}

}  // namespace

Strata make_strata(const scene::Scene& scene) {
    Extent extent{};
    const std::vector<double> borders = strip_borders(scene, extent);
    Strata strata;
    const scene::Lem& lem = scene::lem_of(scene);
    if (lem.water) strata.gamma_w = lem.water->density * scene.gravity;
    for (std::size_t i = 0; i + 1 < borders.size(); ++i) {
        add_strip(scene, borders[i], borders[i + 1], extent, strata);
    }
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
