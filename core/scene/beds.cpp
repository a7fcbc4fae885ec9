#include "core/scene/beds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace breach::scene {

namespace {

constexpr double level_tolerance = 1e-6;  // [m]
constexpr double usual_gravity = 9.81;    // for a ratio only

/// Residual shear strength at a depth below the top of dry soil [Pa]; infinite: it cannot fail.
/// Dry, because it only distinguishes firm from weak soil.
double residual_strength(const Material& material, const materials::Place& place) {
    if (material.strength) {
        const auto of = materials::strength_of_point(*material.strength, place,
                                                     materials::Liquefaction::before);
        return of.c_residual + place.sigma_v0 * of.tan_phi_residual;
    }
    const auto limit = materials::limit_strength(material.law);
    if (!limit) return std::numeric_limits<double>::infinity();
    const materials::Softening* softening = materials::softening(material.law);
    if (!softening) return limit->c + place.sigma_v0 * limit->tan_phi;
    return softening->c_residual + place.sigma_v0 * softening->tan_phi_residual;
}

/// A soil of material points in a region, and its outline.
struct Drawn {
    Soil soil;
    const Polygon& polygon;
    Box box;
};

std::vector<Drawn> drawn_soils(const Scene& scene) {
    std::vector<Drawn> drawn;
    for (const Soil& soil : soils_of(scene)) {
        const Polygon& polygon = scene.section.regions[soil.region].polygon;
        if (polygon.empty() || !materials::is_for_particles(scene.materials[soil.material].law))
            continue;
        drawn.push_back({soil, polygon, geometry::bounding_box(polygon)});
    }
    return drawn;
}

bool lies_in(const Vec2& place, const Drawn& soil) {
    return (place.array() >= soil.box.low.array()).all() &&
           (place.array() <= soil.box.high.array()).all() &&
           geometry::contains(soil.polygon, place);
}

bool is_firm_under(const Scene& scene, const Soil& bed, const Drawn& cover, const Vec2& place) {
    const Material& below = scene.materials[bed.material];
    const Material& above = scene.materials[cover.soil.material];
    const double depth = std::max(cover.box.high.y() - place.y(), 0.0);
    const materials::Place where{depth, place.y(), above.density * usual_gravity * depth};
    const double weak = residual_strength(above, where);
    return std::isfinite(weak) && residual_strength(below, where) >= firm_strength_ratio * weak;
}

/// A region on this edge of a soil that is weak compared with it.
std::optional<std::size_t> weak_cover(const Scene& scene, const std::vector<Drawn>& drawn,
                                      const Soil& bed, const Vec2& from, const Vec2& to) {
    constexpr int samples = 16;
    const Vec2 along = to - from;
    const Vec2 out = Vec2{along.y(), -along.x()}.normalized();
    for (int k = 0; k < samples; ++k) {
        const Vec2 place = from + (k + 0.5) / samples * along + 1e-3 * out;
        for (const Drawn& cover : drawn) {
            if (cover.soil.region == bed.region || !lies_in(place, cover)) continue;
            if (is_firm_under(scene, bed, cover, place)) return cover.soil.region;
        }
    }
    return std::nullopt;
}

bool is_same_top(const Bed& a, const Bed& b) {
    if (a.region != b.region || a.material != b.material ||
        a.level.has_value() != b.level.has_value())
        return false;
    return !a.level || std::abs(*a.level - *b.level) <= level_tolerance;
}

}  // namespace

std::vector<Bed> beds_of(const Scene& scene) {
    const std::vector<Drawn> drawn = drawn_soils(scene);
    std::vector<Bed> beds;
    for (const auto& [soil, polygon, box] : drawn) {
        for (std::size_t k = 0; k < polygon.size(); ++k) {
            const Vec2& from = polygon[k];
            const Vec2& to = polygon[(k + 1) % polygon.size()];
            const Vec2 along = to - from;  // counter-clockwise: top edges run to the left
            if (along.x() >= 0.0 || std::abs(along.y()) > -along.x()) continue;
            const auto cover = weak_cover(scene, drawn, soil, from, to);
            if (!cover) continue;
            Bed bed{soil.region, soil.material, *cover, std::nullopt};
            if (std::abs(along.y()) <= level_tolerance) bed.level = from.y();
            const auto same = [&](const Bed& known) { return is_same_top(known, bed); };
            if (std::ranges::none_of(beds, same)) beds.push_back(bed);
        }
    }
    return beds;
}

double cells_up_to(const Mpm& mpm, double level) {
    return (level - mpm.floor.level) / mpm.cell_size;
}

std::optional<std::int32_t> line_at(const Mpm& mpm, double level) {
    constexpr double tolerance = 0.01;  // [cells]
    const double rows = cells_up_to(mpm, level);
    const double line = std::nearbyint(rows);
    if (std::abs(rows - line) > tolerance) return std::nullopt;
    return static_cast<std::int32_t>(line);
}

std::optional<std::int32_t> rows_below_bed(const Scene& scene, std::size_t material) {
    double highest = std::numeric_limits<double>::lowest();
    for (const Drawn& each : drawn_soils(scene))
        if (each.soil.material == material) highest = std::max(highest, each.box.high.y());
    for (const Bed& bed : beds_of(scene)) {
        if (bed.material != material || !bed.level) continue;
        if (*bed.level < highest - level_tolerance) continue;
        const auto line = line_at(mpm_of(scene), *bed.level);
        if (line && *line >= 1) return line;
    }
    return std::nullopt;
}

}  // namespace breach::scene
