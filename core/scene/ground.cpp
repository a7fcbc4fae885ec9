#include "core/scene/ground.hpp"

#include <algorithm>
#include <limits>

#include "core/geometry/polyline.hpp"

namespace breach::scene {

namespace {

double slope_at(const std::vector<Vec2>& line, double x) {
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        if (x < line[i].x() || x >= line[i + 1].x()) continue;
        return (line[i + 1].y() - line[i].y()) / (line[i + 1].x() - line[i].x());
    }
    return 0.0;
}

constexpr double density_of_water = 1000.0;  // kg/m3, where only a line is given

}  // namespace

Ground::Ground(const Scene& scene, const std::vector<bool>& gone) {
    for (std::size_t r = 0; r < scene.section.regions.size(); ++r) {
        const Region& region = scene.section.regions[r];
        layers_.push_back({.polygon = region.polygon,
                           .gamma = scene.materials[region.material].density * scene.gravity,
                           .line = std::nullopt,
                           .is_gone = !gone.empty() && gone[r]});
    }
    const auto fill = [&](const Line& line, const std::vector<std::size_t>& regions) {
        if (regions.empty())
            for (Layer& layer : layers_) layer.line = line;
        for (const std::size_t region : regions) layers_[region].line = line;
    };
    if (scene.lem && scene.lem->has_water()) {
        const auto line_of = [&](const Water& water, bool stands_free) {
            return Line{water.line, water.density * scene.gravity, water.correction, stands_free};
        };
        if (scene.lem->water) {
            free_water_ = line_of(*scene.lem->water, true);
            fill(*free_water_, scene.lem->water->regions);
        }
        for (const Water& each : scene.lem->piezometric_lines)
            if (!each.regions.empty()) fill(line_of(each, false), each.regions);
        for (const PorePressureRatio& each : scene.lem->pore_pressure_ratios)
            layers_[each.region].r_u = each.r_u;
        return;
    }
    const bool wet = scene.fem && scene.fem->water;
    const bool marked = scene.transfer && !scene.transfer->phreatic_line.empty();
    if (!wet && !marked) return;
    free_water_ = Line{wet ? scene.fem->water->line : scene.transfer->phreatic_line,
                       (wet ? scene.fem->water->density : density_of_water) * scene.gravity,
                       PhreaticCorrection::none, true};
    fill(*free_water_, {});
}

double Ground::pressure(const Line& line, const Vec2& place, double ground) const {
    const double level = geometry::level_at(line.points, place.x());
    const double slope = slope_at(line.points, place.x());
    const bool corrected = line.correction == PhreaticCorrection::cos2;
    const double gamma = corrected ? line.gamma / (1.0 + slope * slope) : line.gamma;
    if (!line.stands_free || level <= ground) {
        const double below = level - place.y();
        return below > 0.0 ? gamma * below : 0.0;
    }
    return line.gamma * (level - ground) + gamma * (ground - place.y());
}

Ground::Stress Ground::stress(const Vec2& place, std::size_t region) const {
    double weight = 0.0;
    double ground = -std::numeric_limits<double>::infinity();
    for (const Layer& layer : layers_) {
        if (layer.is_gone) continue;
        const std::vector<double> heights = geometry::crossings(layer.polygon, place.x());
        for (std::size_t k = 0; k + 1 < heights.size(); k += 2) {
            ground = std::max(ground, heights[k + 1]);
            weight += layer.gamma * std::max(heights[k + 1] - std::max(heights[k], place.y()), 0.0);
        }
    }
    if (!(ground > place.y())) return {place.y(), 0.0, 0.0};  // on the ground, or beside it
    const Layer& own = layers_[region];
    double u = own.line ? pressure(*own.line, place, ground) : 0.0;
    if (u == 0.0) u = own.r_u * weight;
    if (free_water_) {
        const double level = geometry::level_at(free_water_->points, place.x());
        weight += free_water_->gamma * std::max(0.0, level - ground);
    }
    return {ground, weight, u};
}

materials::Place Ground::at(const Vec2& place, std::size_t region) const {
    const Stress found = stress(place, region);
    return {found.ground - place.y(), place.y(), found.sigma - found.u};
}

double Ground::r_u_at_base(std::size_t region) const {
    constexpr int columns = 64;
    const Polygon& polygon = layers_[region].polygon;
    if (polygon.empty()) return 0.0;
    const Box box = geometry::bounding_box(polygon);
    double u = 0.0, sigma = 0.0;
    for (int i = 0; i < columns; ++i) {
        const double x = box.low.x() + (box.high.x() - box.low.x()) * (i + 0.5) / columns;
        const std::vector<double> heights = geometry::crossings(polygon, x);
        if (heights.empty()) continue;
        const Stress found = stress(Vec2(x, heights.front()), region);
        u += found.u;
        sigma += found.sigma;
    }
    return sigma > 0.0 ? u / sigma : 0.0;
}

bool is_below_water(const Section& section, const Region& region, const std::vector<Vec2>& line) {
    constexpr double shallow = 0.02;  // of the section's height
    if (line.empty()) return false;
    const Box box = geometry::extent(section);
    const double below = geometry::deepest_below(region.polygon, line, geometry::level_at).below;
    return below > shallow * (box.high.y() - box.low.y());
}

}  // namespace breach::scene
