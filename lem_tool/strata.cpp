#include "lem_tool/strata.hpp"

#include <algorithm>
#include <cmath>
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

std::vector<double> strip_borders(const scene::Section& section, Extent& extent) {
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
    std::sort(xs.begin(), xs.end());
    extent = {xs.back() - xs.front(), high - low};
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
    Strip strip{from, to, strata.layers.size(), 0, pieces.back().bottom};
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
    const std::vector<double> borders = strip_borders(scene.section, extent);
    Strata strata;
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
