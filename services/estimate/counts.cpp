// Counts what phases will mesh, fill and search, from the scene alone: a form that is typed into
// gets its cost at once, and no program is started. Constants marked as measured are of runs on one
// machine; counts do not depend on the machine.
#include "services/estimate/counts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <utility>

#include "core/scene/resolution.hpp"
#include "core/scene/stiffness.hpp"

namespace breach::estimate {

using geometry::Polygon;
using scene::Vec2;

namespace {

// Recombined quads are smaller than requested (Mochikoshi at 1 m: 5,494 for an area of 4,450).
constexpr double gmsh_excess = 1.25;
// Elements have whole numbers of points (Mochikoshi with 9, 16 and 25 in a cell: 1.16 to 1.02).
constexpr double points_excess = 1.1;

/// Blocks and strips have even numbers of elements along their sides.
double even(double divisions) { return 2.0 * std::max(1.0, std::round(0.5 * divisions)); }

double block_elements(const Polygon& block, double h) {
    const geometry::Box box = geometry::bounding_box(block);
    const Vec2 size = box.high - box.low;
    const double share = geometry::area(block) / (size.x() * size.y());
    return even(size.x() / h) * even(share * size.y() / h);
}

/// Elements of a strip with widths from `first` to `last`: the integral of dx over the width.
double strip_elements(const Polygon& strip, double first, double last) {
    if (strip.size() < 3) return 0.0;
    const geometry::Box box = geometry::bounding_box(strip);
    const double length = box.high.x() - box.low.x();
    if (length <= 0.0) return 0.0;
    const double columns =
        last > 1.01 * first ? length * std::log(last / first) / (last - first) : length / first;
    return even(columns) * even(geometry::area(strip) / length / first);
}

double elements_of(const scene::Region& region) {
    const bool block = region.mesh == scene::RegionMesh::block;
    if (block && region.divisions[0] > 0)
        return static_cast<double>(region.divisions[0]) * region.divisions[1];
    const double h = region.element_size;
    if (h <= 0.0 || region.polygon.empty()) return 0.0;
    Polygon middle = region.polygon;
    double elements = 0.0;
    /// Cuts off the part right of the line from a to b as a strip.
    const auto cut = [&](const Vec2& a, const Vec2& b) {
        elements += strip_elements(geometry::clipped_left(middle, b, a), h, region.grading.largest);
        middle = geometry::clipped_left(middle, a, b);
    };
    if (const auto x = region.grading.left_of) cut({*x, 1.0}, {*x, 0.0});
    if (const auto x = region.grading.right_of) cut({*x, 0.0}, {*x, 1.0});
    if (middle.size() > 2)
        elements +=
            block ? block_elements(middle, h) : gmsh_excess * geometry::area(middle) / (h * h);
    return std::max(1.0, elements);
}

double height_of(const scene::Scene& scene) {
    const scene::Mpm& mpm = *scene.mpm;
    const double H = scene::mobile_height(scene, mpm);
    return H > 0.0 ? H : mpm.domain_y[1] - mpm.domain_y[0];
}

/// Time scale of a fall, sqrt(H / g) [s]: durations of runouts of very different size agree in it.
double T_of(const scene::Scene& scene) {
    return std::sqrt(height_of(scene) / (scene.gravity > 0.0 ? scene.gravity : 9.81));
}

/// As the transfer decides: within the zone's regions, and with layers only their materials.
bool can_liquefy(const scene::LiquefiedZone& zone, const scene::Soil& soil) {
    const bool is_layer = std::ranges::any_of(zone.layers, [&](const scene::LiquefiedLayer& each) {
        return each.material == soil.material;
    });
    return std::ranges::count(zone.regions, soil.region) > 0 && (zone.layers.empty() || is_layer);
}

/// Of wet NorSand and other laws by state: the transfer gives it s_u by the state of each point.
constexpr double undrained_by_state = 0.02;  // over rho g H

/// Strength of a soil that has softened or liquefied, at half the depth of the mobile soil, over
/// rho g H; nothing: it does not yield.
std::optional<double> residual_share(const scene::Scene& scene, const scene::Soil& soil, double H) {
    if (soil.material >= scene.materials.size()) return std::nullopt;
    const scene::Material& material = scene.materials[soil.material];
    if (!materials::traits(material.law).yields) return std::nullopt;
    const double total = material.density * scene.gravity * H;
    const double sigma_v0 = 0.25 * total;  // half the depth, half of it carried by water
    if (scene.fem && scene.transfer && scene.transfer->liquefied &&
        can_liquefy(*scene.transfer->liquefied, soil)) {
        const std::size_t before = scene.section.regions[soil.region].material;
        if (before < scene.materials.size() &&
            materials::has_state_parameter(scene.materials[before].law))
            return undrained_by_state;
    }
    const auto share = [&](double c, double tan_phi) { return (c + tan_phi * sigma_v0) / total; };
    if (material.strength) {
        const auto& curve =
            material.strength->residual ? *material.strength->residual : material.strength->peak;
        const auto strength = materials::strength_at(curve, {0.5 * H, 0.0, sigma_v0});
        return share(strength.c, strength.tan_phi);
    }
    if (const materials::Softening* softening = materials::softening(material.law))
        return share(softening->c_residual, softening->tan_phi_residual);
    const auto strength = materials::limit_strength(material.law);
    return strength ? std::optional(share(strength->c, strength->tan_phi)) : std::nullopt;
}

/// Of all mobile soil: the harmonic mean over its area, because what flows is the weak part.
double residual_share(const scene::Scene& scene) {
    const scene::Mpm& mpm = *scene.mpm;
    const double H = height_of(scene);
    const std::vector<scene::Soil> soils = scene::soils_of(scene);
    double area = 0.0, weakness = 0.0;
    for (const scene::Soil& each : soils) {
        const scene::Region& region = scene.section.regions[each.region];
        const auto share = residual_share(scene, each, H);
        if (!share || !scene::is_mobile(region, mpm)) continue;
        const double part =
            geometry::area(region.polygon) /
            static_cast<double>(std::ranges::count(soils, each.region, &scene::Soil::region));
        area += part;
        weakness += part / std::max(*share, 1e-3);
    }
    return weakness > 0.0 ? area / weakness : 1.0;
}

/// The strength of a material in the LEM, if it has one.
std::optional<materials::Strength> limit_strength(const scene::Material& material) {
    if (const auto& own = material.limit_strength)
        return materials::Strength{own->c, std::tan(own->phi)};
    if (scene::lem_takes_profile(material))
        return materials::strength_at(material.strength->peak, {10.0, 0.0, 1e5});
    if (!materials::traits(material.law).c_and_phi) return std::nullopt;
    return materials::limit_strength(material.law);
}

/// Searches for this number of variations, and one for the surface without them.
double searches_for(scene::VariedSurface surface, double variations, double surfaces) {
    return 1.0 + (surface == scene::VariedSurface::searched ? variations : variations / surfaces);
}

/// Straight lower borders of regions that circles can touch, each once, above the lowest level.
double boundaries_of(const scene::Scene& scene) {
    const auto& lowest = scene.lem->search->lowest_level;
    std::set<std::pair<double, double>> lines;
    for (const scene::Region& region : scene.section.regions) {
        const Polygon& ring = region.polygon;
        const bool anticlockwise = geometry::signed_area(ring) > 0.0;
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Vec2& a = ring[i];
            const Vec2& b = ring[(i + 1) % ring.size()];
            const double run = anticlockwise ? b.x() - a.x() : a.x() - b.x();
            if (run <= 0.0 || (lowest && std::max(a.y(), b.y()) <= *lowest)) continue;
            const double slope = (b.y() - a.y()) / (b.x() - a.x());
            lines.emplace(std::round(1e6 * slope), std::round(1e3 * (a.y() - slope * a.x())));
        }
    }
    return static_cast<double>(lines.size()) + (lowest ? 1.0 : 0.0);
}

/// Vertical strips of the section: each vertex of a region or of the phreatic line begins one.
double strips_of(const scene::Scene& scene) {
    std::set<double> starts;
    const auto add = [&](const std::vector<Vec2>& points) {
        for (const Vec2& p : points) starts.insert(std::round(1e6 * p.x()));
    };
    for (const scene::Region& region : scene.section.regions) add(region.polygon);
    if (scene.lem->water) add(scene.lem->water->line);
    return static_cast<double>(starts.size()) - 1.0;
}

/// Strength of a region at 100 kPa [Pa].
double strength_of(const scene::Scene& scene, const scene::Region& region) {
    constexpr double unknown = std::numeric_limits<double>::infinity();
    if (region.material >= scene.materials.size()) return unknown;
    const auto strength = limit_strength(scene.materials[region.material]);
    return strength ? strength->c + 1e5 * strength->tan_phi : unknown;
}

/// Layers thinner than a tenth of their depth and weaker than all thicker soil: one search each.
double thin_weak_layers(const scene::Scene& scene) {
    const double top = geometry::extent(scene.section).high.y();
    const auto is_thin = [&](const scene::Region& region) {
        const geometry::Box box = geometry::bounding_box(region.polygon);
        const double thickness = geometry::area(region.polygon) / (box.high.x() - box.low.x());
        return thickness < 0.1 * (top - box.low.y());
    };
    double least = std::numeric_limits<double>::infinity();
    for (const scene::Region& each : scene.section.regions)
        if (!is_thin(each)) least = std::min(least, strength_of(scene, each));
    return static_cast<double>(
        std::ranges::count_if(scene.section.regions, [&](const scene::Region& each) {
            return is_thin(each) && strength_of(scene, each) < 0.95 * least;
        }));
}

/// Slices of a full search, of its grid only, and of the grid without the scene's bounds.
struct SlicesCut {
    double whole, grid, without_bounds;
};

SlicesCut slices_cut(const scene::Scene& scene) {
    constexpr double coarse_slices = 25.0;
    constexpr double descents = 4600.0;  // measured: 4,073 to 4,600 for 24 x 24 x 24
    const scene::Lem& lem = *scene.lem;
    const scene::SlipSearch& search = *lem.search;
    const double touching = 2.0 * boundaries_of(scene), strips = strips_of(scene);
    const double pairs = static_cast<double>(search.entry_points) * search.exit_points;
    const double per_circle = std::min<double>(lem.slices, coarse_slices) + strips;
    const double grid = pairs * (search.depths + touching) * per_circle;
    constexpr double coarser = 2.0 / 3.0;
    return {grid + descents * (lem.slices + strips), grid,
            coarser * coarser * pairs * (coarser * search.depths + touching) * per_circle};
}

/// Polylines: the given one, and those of the descent from each stage's surface, if they are
/// requested or a thin weak layer exists.
double polylines_of(const scene::Lem& lem, double thin_layers) {
    constexpr int usual_vertices = 13;
    const double given = lem.non_circular && !lem.non_circular->given.empty() ? 1.0 : 0.0;
    const int asked = lem.non_circular ? lem.non_circular->vertices : 0;
    const int vertices = asked == 0 && thin_layers > 0.0 ? usual_vertices : asked;
    const auto stages = static_cast<double>(lem.liquefaction.size());
    const double descents = stages > 0.0 ? 2.0 + stages : 1.0;  // the intact stage twice
    // measured: 7,336, 10,401 and 16,784 with 13, 30 and 60 vertices, 6,105 to 8,859 with 13
    return given + descents * 2100.0 * std::sqrt(vertices);
}

}  // namespace

std::vector<double> elements_of(const scene::Scene& scene) {
    std::vector<double> elements;
    for (const scene::Region& each : scene.section.regions) elements.push_back(elements_of(each));
    return elements;
}

double soil_area(const scene::Scene& scene) {
    double sum = 0.0;
    for (const scene::Region& each : scene.section.regions) sum += geometry::area(each.polygon);
    return sum;
}

FemSteps steps_of(const scene::Fem& fem) {
    FemSteps all{0.0, 0.0};
    for (const scene::Stage& stage : fem.stages) {
        if (stage.kind == scene::StageKind::static_equilibrium) {
            all.steps += stage.load_steps;
        } else {
            all.duration += stage.duration;
            if (stage.time_step > 0.0) all.steps += std::ceil(stage.duration / stage.time_step);
        }
    }
    return all;
}

double snapshots_of(const scene::Fem& fem) {
    const double regular =
        fem.snapshot_interval > 0.0 ? steps_of(fem).duration / fem.snapshot_interval : 0.0;
    return 1.0 + static_cast<double>(fem.snapshot_times.size()) + std::floor(regular);
}

double points_of(const scene::Scene& scene, double elements) {
    const double cell = scene.mpm ? scene.mpm->cell_size * scene.mpm->cell_size : 1.0;
    const double cells = soil_area(scene) / cell;
    if (!scene.fem || !scene.transfer) {
        const double per_direction = scene.mpm ? scene.mpm->fill_points : 2;
        return cells * per_direction * per_direction;
    }
    const int n = scene.transfer->points_per_direction;
    const double by_element = elements * n * n;
    if (!scene.transfer->points_per_cell || !scene.mpm) return by_element;
    return points_excess * std::max(by_element, cells * *scene.transfer->points_per_cell);
}

double runout_duration(const scene::Scene& scene) {
    const scene::Mpm& mpm = *scene.mpm;
    if (!mpm.until_rest) return mpm.duration;
    // Measured in T_of: 51 at a share of 0.0065, 30 at 0.012, 24 at 0.024, 16 at 0.033, 13 at 0.05.
    const double falls = std::clamp(1.45 * std::pow(residual_share(scene), -0.77), 7.0, 120.0);
    const double likely = falls * T_of(scene);
    return std::min(std::max(likely, mpm.rest.earliest), mpm.duration);
}

double runout_step(const scene::Scene& scene) {
    const scene::Mpm& mpm = *scene.mpm;
    if (mpm.time_step) return *mpm.time_step;
    const double fastest = std::max(scene::fastest_wave(scene, mpm), 1.0);
    double damping = 0.0;
    for (const scene::Soil& soil : scene::soils_of(scene)) {
        if (soil.material >= scene.materials.size()) continue;
        const scene::Material& material = scene.materials[soil.material];
        damping =
            std::max(damping, 16.0 / 3.0 * material.viscosity / material.density / mpm.cell_size);
    }
    const double fall = T_of(scene) * (scene.gravity > 0.0 ? scene.gravity : 9.81);  // sqrt(g H)
    return mpm.cfl * mpm.cell_size / (fastest + fall + damping);
}

Searches searches_of(const scene::Scene& scene) {
    const scene::Lem& lem = *scene.lem;
    constexpr double refinement = 1.33;  // measured: 18,424 and 17,897 for 24 x 24 x 24
    const double thin_layers = lem.search ? thin_weak_layers(scene) : 0.0;
    Searches all{1.0, 1.0 + static_cast<double>(lem.liquefaction.size()),
                 polylines_of(lem, thin_layers), 0.0};
    SlicesCut cut{static_cast<double>(lem.slices), 0.0, 0.0};
    if (lem.search) {
        all.surfaces =
            refinement * lem.search->entry_points * lem.search->exit_points * lem.search->depths;
        cut = slices_cut(scene);
    }
    // The crack's depth is searched on 2 to 13 grids; one or two full searches follow.
    constexpr double wholes_with_crack = 2.5, grids_with_crack = 7.0;
    const double family =
        lem.tension_crack ? wholes_with_crack * cut.whole + grids_with_crack * cut.grid : cut.whole;
    all.slices = all.stages * ((1.0 + thin_layers) * family + cut.without_bounds);
    double varied = 0.0;
    if (lem.probability)
        varied += searches_for(lem.probability->surface, lem.probability->samples, all.surfaces);
    all.stages += varied;
    all.slices += varied * cut.whole;
    return all;
}

}  // namespace breach::estimate
