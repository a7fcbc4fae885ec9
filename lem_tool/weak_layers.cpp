// Layers of a strip become bands of similar strength, weak bands chains from strip to strip, and
// thin chains lines that a surface may follow.
#include "lem_tool/weak_layers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lem_tool/slice_maker.hpp"

namespace breach::lem {

namespace {

/// Thickness over the slide's depth below which a circle cannot follow the layer.
constexpr double thin = 0.1;
/// Strength over the neighbour's below which a layer counts as weaker.
constexpr double weaker = 0.95;

/// Adjacent layers of similar strength within a strip.
struct Band {
    Line top;
    Line bottom;
    bool is_weak;
};

/// Weak bands connected from strip to strip.
struct Chain {
    std::size_t last_strip;
    Path bottom;
    double thickness = 0.0;  ///< largest, within the search's ranges [m]
    double depth = 0.0;      ///< largest, of the bottom below ground [m]

    bool is_thin() const { return thickness < thin * depth; }
};

class WeakBands {
  public:
    explicit WeakBands(const Model& model) : model_(model), slices_(make_slices(model.strata, 1)) {}

    std::vector<Band> of(const Strip& strip) {
        std::vector<Band> bands;
        std::vector<double> top, bottom;  // strength at the bands' borders [Pa]
        const double middle = 0.5 * (strip.from + strip.to);
        for (std::size_t k = strip.first; k < strip.last; ++k) {
            const Line& upper = model_.strata.layers[k].top;
            if (upper.at(middle) <= strip.bottom.at(middle)) break;  // below the lowest level
            const bool has_lower = k + 1 < strip.last && model_.strata.layers[k + 1].top.at(
                                                             middle) > strip.bottom.at(middle);
            const Line& lower = has_lower ? model_.strata.layers[k + 1].top : strip.bottom;
            const double at_top = strength(strip, upper, lower, 0.0);
            const double at_bottom = strength(strip, upper, lower, 1.0);
            // Layers of similar strength are one band: a sand drawn in three parts is no seam.
            const bool like = !bands.empty() && at_top >= weaker * bottom.back() &&
                              bottom.back() >= weaker * at_top;
            if (like) {
                bands.back().bottom = lower;
                bottom.back() = at_bottom;
                continue;
            }
            bands.push_back({upper, lower, false});
            top.push_back(at_top);
            bottom.push_back(at_bottom);
        }
        for (std::size_t b = 1; b < bands.size(); ++b)
            bands[b].is_weak = top[b] < weaker * bottom[b - 1] &&
                               (b + 1 == bands.size() || bottom[b] < weaker * top[b + 1]) &&
                               bands[b].bottom.at(middle) > strip.floor.at(middle);
        return bands;
    }

  private:
    /// Strength just inside a layer, at its upper (share 0) or lower border, in the strip's middle
    /// [Pa].
    double strength(const Strip& strip, const Line& upper, const Line& lower, double share) {
        constexpr double inside = 1e-3;
        const double x = 0.5 * (strip.from + strip.to);
        const double half = 1e-3 * (strip.to - strip.from);
        const double height = upper.at(x) - lower.at(x);
        const double y = upper.at(x) - (inside + share * (1.0 - 2.0 * inside)) * height;
        const scene::Circle pivot{{x, y + height + half}, height + half};
        SliceMaker maker(model_.strata, model_.soils, pivot, 2.0 * half, slices_);
        const Cut verdict =
            maker.add_piece(strip, x - half, x + half, Base::straight, [&](double) { return y; });
        if (verdict != Cut::done) return std::numeric_limits<double>::infinity();
        const double normal = slices_.weight[0] / slices_.width[0] - slices_.u[0];
        constexpr double no_strength = 1.0;  // [Pa]: layers without strength are equal
        return slices_.c[0] + std::max(0.0, normal) * slices_.tan_phi[0] + no_strength;
    }

    const Model& model_;
    Slices slices_;
};

/// Extrapolates the path linearly to both sides.
Path to_both_sides(Path path, double from, double to) {
    const auto at = [](const scene::Vec2& a, const scene::Vec2& b, double x) {
        return scene::Vec2(x, a.y() + (b.y() - a.y()) * (x - a.x()) / (b.x() - a.x()));
    };
    const std::size_t n = path.size();
    const scene::Vec2 left = at(path[0], path[1], from);
    const scene::Vec2 right = at(path[n - 2], path[n - 1], to);
    if (path.front().x() > from) path.insert(path.begin(), left);
    if (path.back().x() < to) path.push_back(right);
    return path;
}

double level_at(const Path& path, double x) {
    if (x <= path.front().x()) return path.front().y();
    if (x >= path.back().x()) return path.back().y();
    const auto next = std::ranges::upper_bound(path, x, {}, [](const auto& p) { return p.x(); });
    const scene::Vec2& a = *(next - 1);
    return a.y() + (next->y() - a.y()) * (x - a.x()) / (next->x() - a.x());
}

}  // namespace

Path higher(const Path& one, const Path& other) {
    if (one.empty() || other.empty()) return one.empty() ? other : one;
    std::vector<double> xs;
    for (const Path* each : {&one, &other})
        for (const scene::Vec2& p : *each) xs.push_back(p.x());
    std::ranges::sort(xs);
    const auto gap = [&](double x) { return level_at(one, x) - level_at(other, x); };
    const std::size_t kinks = xs.size();
    for (std::size_t i = 0; i + 1 < kinks; ++i) {
        const double before = gap(xs[i]), after = gap(xs[i + 1]);
        if (before * after < 0.0)
            xs.push_back(xs[i] + (xs[i + 1] - xs[i]) * before / (before - after));
    }
    std::ranges::sort(xs);
    xs.erase(std::unique(xs.begin(), xs.end()), xs.end());
    Path path;
    for (const double x : xs) path.emplace_back(x, std::max(level_at(one, x), level_at(other, x)));
    return path;
}

static std::vector<Chain> chains_in(const Model& model, const scene::SlipSearch& ranges) {
    const Strata& strata = model.strata;
    const double near = 1e-6 * (strata.right() - strata.left());
    const double from = std::min(ranges.entry[0], ranges.exit[0]);
    const double to = std::max(ranges.entry[1], ranges.exit[1]);
    WeakBands bands(model);
    std::vector<Chain> chains;
    for (std::size_t i = 0; i < strata.strips.size(); ++i) {
        const Strip& strip = strata.strips[i];
        for (const Band& band : bands.of(strip)) {
            if (!band.is_weak) continue;
            const scene::Vec2 begin(strip.from, band.bottom.at(strip.from));
            const auto found = std::ranges::find_if(chains, [&](const Chain& each) {
                return each.last_strip + 1 == i &&
                       // A seam is one chain as long as its bottom goes on without a step.
                       std::abs(each.bottom.back().y() - begin.y()) <= near;
            });
            const bool continues = found != chains.end();
            if (!continues) chains.push_back({i, {begin}});
            Chain& chain = continues ? *found : chains.back();
            chain.last_strip = i;
            chain.bottom.emplace_back(strip.to, band.bottom.at(strip.to));
            for (const double x : {std::max(from, strip.from), std::min(to, strip.to)}) {
                // Thickness and depth count where surfaces can be: outside the ranges a seam may be
                // thick.
                if (x < strip.from || x > strip.to) continue;
                chain.thickness = std::max(chain.thickness, band.top.at(x) - band.bottom.at(x));
                chain.depth = std::max(chain.depth, strata.ground(strip).at(x) - band.bottom.at(x));
            }
        }
    }
    std::erase_if(chains, [](const Chain& each) { return each.thickness <= 0.0; });
    return chains;
}

std::vector<Path> weak_lines(const Model& model, const scene::SlipSearch& ranges) {
    std::vector<Path> lines;
    for (const Chain& chain : chains_in(model, ranges))
        if (chain.is_thin())
            lines.push_back(to_both_sides(chain.bottom, model.strata.left(), model.strata.right()));
    return lines;
}

bool has_thick_weak_layer(const Model& model, const scene::SlipSearch& ranges) {
    return std::ranges::any_of(chains_in(model, ranges),
                               [](const Chain& each) { return !each.is_thin(); });
}

Model over_floor(const scene::Scene& scene, const Model& model, const Path& floor) {
    scene::Scene floored = scene;
    floored.lem->floor = floor;
    Model result = model;
    result.strata = make_strata(floored);
    result.strata.crack.share = model.strata.crack.share;
    return result;
}

}  // namespace breach::lem
