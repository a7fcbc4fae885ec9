// Called by begin.cpp for a run without --input; the log of every run compares its points with the
// section (sampling_of). Exact areas and levels matter more than equal points: a whole number of
// points per cell once sampled a pond of 29.4 m as 30.0 m.
#include "mpm_solver/body/fill.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/scene/ground.hpp"
#include "mpm_solver/body/overburden.hpp"

namespace breach::mpm {

using geometry::Box;
using geometry::Polygon;
using scene::Vec2;

namespace {

/// Keeps the part of a simple polygon with sign * (x_axis - at) >= 0 (Sutherland & Hodgman 1974).
/// Separate parts stay joined by edges of zero width, so areas and moments are exact.
Polygon cut(const Polygon& polygon, int axis, double at, double sign) {
    Polygon kept;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Vec2& from = polygon[k];
        const Vec2& to = polygon[(k + 1) % polygon.size()];
        const double from_in = sign * (from[axis] - at);
        const double to_in = sign * (to[axis] - at);
        if (from_in >= 0.0) kept.push_back(from);
        if ((from_in > 0.0 && to_in < 0.0) || (from_in < 0.0 && to_in > 0.0)) {
            kept.push_back(from + (to - from) * (from_in / (from_in - to_in)));
        }
    }
    return kept;
}

/// Area and centroid of a counter-clockwise polygon.
struct Patch {
    double area;
    Vec2 centroid;
};

Patch patch_of(const Polygon& polygon) {
    if (polygon.size() < 3) return {0.0, Vec2::Zero()};
    // Relative to a vertex: products of coordinates far from the origin would cancel.
    const Vec2& base = polygon[0];
    double area = 0.0;
    Vec2 moment = Vec2::Zero();
    for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
        const Vec2 a = polygon[k] - base;
        const Vec2 b = polygon[k + 1] - base;
        const double part = 0.5 * (a.x() * b.y() - a.y() * b.x());
        area += part;
        moment += part * (a + b) / 3.0;
    }
    if (area <= 0.0) return {0.0, base};
    return {area, base + moment / area};
}

using Place = std::pair<int, int>;  ///< (column, row) of a square
/// Ordered by column and row: that is the order of a region's points in all outputs.
using Patches = std::map<Place, Patch>;

Patch joined(const Patch& a, const Patch& b) {
    const double area = a.area + b.area;
    return {area, (a.area * a.centroid + b.area * b.centroid) / area};
}

/// Points of very small mass would be thrown around: parts below a quarter square join the largest
/// neighbour.
void join_slivers(Patches& patches, double square) {
    for (auto sliver = patches.begin(); sliver != patches.end();) {
        Patch* best = nullptr;
        // By sides only: a point joined over a corner would lie outside both squares.
        if (sliver->second.area < 0.25 * square) {
            for (const Place& step : {Place{-1, 0}, Place{1, 0}, Place{0, -1}, Place{0, 1}}) {
                const auto next = patches.find(
                    {sliver->first.first + step.first, sliver->first.second + step.second});
                if (next != patches.end() && (!best || next->second.area > best->area)) {
                    best = &next->second;
                }
            }
        }
        if (!best) {
            ++sliver;
            continue;
        }
        *best = joined(*best, sliver->second);
        sliver = patches.erase(sliver);
    }
}

Patches sample(const Polygon& polygon, const Vec2& origin, double spacing) {
    const Box box = geometry::bounding_box(polygon);
    const auto first = [&](int axis) {
        return static_cast<int>(std::floor((box.low[axis] - origin[axis]) / spacing));
    };
    const auto last = [&](int axis) {
        return static_cast<int>(std::ceil((box.high[axis] - origin[axis]) / spacing));
    };
    Patches patches;
    for (int i = first(0); i < last(0); ++i) {
        // Once per column: its squares are then cut from a polygon that has few vertices left.
        const Polygon column = cut(cut(polygon, 0, origin.x() + i * spacing, 1.0), 0,
                                   origin.x() + (i + 1) * spacing, -1.0);
        for (int j = first(1); j < last(1); ++j) {
            const Patch patch = patch_of(cut(cut(column, 1, origin.y() + j * spacing, 1.0), 1,
                                             origin.y() + (j + 1) * spacing, -1.0));
            if (patch.area > 1e-9 * spacing * spacing) patches[{i, j}] = patch;
        }
    }
    join_slivers(patches, spacing * spacing);
    return patches;
}

mechanics::Voigt stress_at(const scene::Scene& scene, const scene::StandingWater& water,
                           const Vec2& place, const mechanics::Elasticity& soil) {
    if (scene::mpm_of(scene).fill_stress == scene::FillStress::none) {
        return mechanics::Voigt::Zero();
    }
    return column_stress(overburden(scene, water, place), soil.nu);
}

/// Mass by the region's material, initial stress by the material that it becomes.
void add_point(const scene::Scene& scene, const scene::StandingWater& water, std::size_t region,
               const scene::Material& becomes, const Patch& patch, exchange::ParticleState& state) {
    const scene::Material& material = scene.material_of(region);
    const mechanics::Elasticity soil = materials::elasticity(becomes.law);
    const mechanics::Voigt sigma = stress_at(scene, water, patch.centroid, soil);
    const double sigma_m = (sigma[0] + sigma[1] + sigma[2]) / 3.0;
    const double volume = patch.area * state.thickness;
    state.resize(state.size() + 1);
    state.position.back() = patch.centroid;
    state.mass.back() = material.density * volume;
    // The section is drawn with the soil under its own weight, so `volume` is the compressed one.
    state.volume_0.back() = volume / (1.0 + sigma_m / soil.bulk_modulus());
    state.volume.back() = volume;
    state.stress.back() = sigma;
    state.region.back() = static_cast<std::int32_t>(region);
}

/// Strengths of the last point; zero for a material without a profile, as the arrays have an entry
/// for every point. Nothing has liquefied in a section without transfer.
void add_strength(const scene::Ground& ground, const scene::Material& material, std::size_t region,
                  exchange::ParticleState& state) {
    materials::PointStrength of{};
    if (materials::has_strength_of_points(material.law))
        of = materials::strength_of_point(*material.strength,
                                          ground.at(state.position.back(), region),
                                          materials::Liquefaction::before);
    state.strength.c.push_back(of.c);
    state.strength.tan_phi.push_back(of.tan_phi);
    state.strength.c_residual.push_back(of.c_residual);
    state.strength.tan_phi_residual.push_back(of.tan_phi_residual);
}

std::vector<const scene::Material*> materials_of_regions(const scene::Scene& scene) {
    const std::vector<scene::Soil> soils = scene::soils_of(scene);
    std::vector<const scene::Material*> become;
    for (std::size_t r = 0; r < scene.section.regions.size(); ++r)
        become.push_back(&scene.materials[soils[r].material]);
    return become;
}

}  // namespace

FilledSection fill_section(const scene::Scene& scene) {
    const scene::Mpm& mpm = scene::mpm_of(scene);
    const double square = mpm.cell_size / mpm.fill_points;
    // Squares tile the grid's cells unless shifted; `draws` of a study shift the lattice to measure
    // how far a runout depends on it.
    const Vec2 origin{mpm.domain_x[0] + mpm.fill_shift[0] * square,
                      mpm.floor.level + mpm.fill_shift[1] * square};
    FilledSection filled;
    filled.state.thickness = scene.thickness;
    const std::vector<const scene::Material*> become = materials_of_regions(scene);
    const bool strengths = std::ranges::any_of(become, [](const scene::Material* each) {
        return materials::has_strength_of_points(each->law);
    });
    const scene::Ground ground(scene);
    const scene::StandingWater water(scene);
    for (std::size_t r = 0; r < scene.section.regions.size(); ++r) {
        const scene::Region& region = scene.section.regions[r];
        filled.state.regions.push_back(region.name);
        filled.state.materials_of_regions.push_back(scene.materials[region.material].name);
        for (const auto& [place, patch] : sample(region.polygon, origin, square)) {
            add_point(scene, water, r, *become[r], patch, filled.state);
            if (strengths) add_strength(ground, *become[r], r, filled.state);
        }
    }
    filled.regions = sampling_of(scene, filled.state);
    return filled;
}

bool is_faithful(const SampledRegion& region) {
    constexpr double tolerance = 0.01;
    return std::abs(region.sampled_area - region.polygon_area) <= tolerance * region.polygon_area &&
           std::abs(region.sampled_level - region.polygon_level) <= tolerance * region.height;
}

std::vector<SampledRegion> sampling_of(const scene::Scene& scene,
                                       const exchange::ParticleState& state) {
    std::vector<SampledRegion> result;
    for (const scene::Region& region : scene.section.regions) {
        const Box box = geometry::bounding_box(region.polygon);
        const Patch drawn = patch_of(region.polygon);
        SampledRegion sampled{.name = region.name,
                              .polygon_area = geometry::area(region.polygon),
                              .sampled_area = 0.0,
                              .polygon_level = drawn.centroid.y(),
                              .sampled_level = 0.0,
                              .height = box.high.y() - box.low.y(),
                              .points = 0};
        for (std::size_t p = 0; p < state.size(); ++p) {
            // By name: a transfer's state has its own list of regions, in the snapshot's order.
            if (state.regions[state.region[p]] != region.name) continue;
            const double area = state.volume[p] / state.thickness;
            sampled.sampled_area += area;
            sampled.sampled_level += area * state.position[p].y();
            ++sampled.points;
        }
        if (sampled.points == 0) continue;
        sampled.sampled_level /= sampled.sampled_area;
        result.push_back(sampled);
    }
    return result;
}

}  // namespace breach::mpm
