// From the exchange's particle state to the loops' arrays and back. Inside, two quantities are not
// those of the scene: K and with it V_0 (stiffness scale), and the softening strain (band width).
// Both directions convert, so that particle files never contain scaled values (checkpoints do).
#include "mpm_solver/body/points.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/scene/beds.hpp"
#include "core/scene/resolution.hpp"
#include "core/scene/stiffness.hpp"
#include "core/words/number.hpp"
#include "mpm_solver/body/choose.hpp"
#include "mpm_solver/body/grid.hpp"

namespace breach::mpm {

namespace {

constexpr double cells_of_damping = 0.55;  // larger ones reduce the time step

/// A shear band is about a cell wide, or as wide as nonlocal softening makes it. Strains in inverse
/// proportion make its dissipation independent of the cells.
double softening_scale(const scene::Mpm& mpm, const scene::Material& soil) {
    if (!mpm.softening_length) return 1.0;
    return *mpm.softening_length / scene::band_width(soil, mpm);
}

materials::LawLanes lanes_of(const materials::Law& law, const scene::Material& soil) {
    const auto lanes = materials::for_particles(law);
    if (lanes) return *lanes;
    throw fault::BadInput(
        "scene",
        {{"/materials/" + soil.name + "/law/type",
          "is " + std::string(materials::traits(law).type) + ", which particles cannot have",
          "give them a material with " +
              materials::types_of_laws_that(materials::is_for_particles)}});
}

double largest_specific_volume(const Points& points, const Zone& zone) {
    double largest = 0.0;
    for (std::size_t p = zone.begin; p < zone.end; ++p) {
        largest = std::max(largest, points.V[p] / points.m[p]);
    }
    return largest;
}

WallRows walls_of(const scene::Scene& scene, std::size_t material) {
    WallRows walls{.low = floor_row};
    if (const auto rows = scene::rows_below_bed(scene, material)) walls.high = floor_row + *rows;
    return walls;
}

Zone zone_of(const scene::Scene& scene, const Points& points, std::size_t material,
             std::size_t begin, std::size_t end) {
    const scene::Mpm& mpm = scene::mpm_of(scene);
    const scene::Material& soil = scene.materials[material];
    const materials::Law law = materials::with_tension_share(
        materials::adapted(soil.law, scene::elasticity_in_runout(soil, mpm),
                           softening_scale(mpm, soil)),
        mpm.tension_share);
    Zone zone{.material = soil.name,
              .law = law,
              .lanes = lanes_of(law, soil),
              .elasticity = materials::elasticity(law),
              .K_drawn = materials::elasticity(soil.law).bulk_modulus(),
              .volume_rule = decide(mpm, {soil.name, law, soil.viscosity}).volume_rule.value,
              .softening_scale = softening_scale(mpm, soil),
              .viscosity = soil.viscosity,
              .damping = damping_of(scene, soil, materials::elasticity(law)).viscosity,
              .nonlocal_length = scene::nonlocal_length_in_runout(soil, mpm).value_or(0.0),
              .walls_y = walls_of(scene, material),
              .begin = begin,
              .end = end};
    zone.largest_specific_volume = largest_specific_volume(points, zone);
    return zone;
}

/// Soil index of each region of the state, by name and material; by name alone if no such soil
/// exists: then the region's own.
std::vector<std::int32_t> match_soils(const scene::Scene& scene,
                                      const std::vector<scene::Soil>& soils,
                                      const exchange::ParticleState& state,
                                      const std::string& file) {
    std::vector<std::int32_t> match;
    std::vector<fault::Fault> faults;
    for (std::size_t r = 0; r < state.regions.size(); ++r) {
        const auto same_region = [&](const scene::Soil& soil) {
            return scene.section.regions[soil.region].name == state.regions[r];
        };
        auto found = std::find_if(soils.begin(), soils.end(), [&](const scene::Soil& soil) {
            return same_region(soil) &&
                   scene.materials[soil.material].name == state.materials_of_regions[r];
        });
        if (found == soils.end()) found = std::find_if(soils.begin(), soils.end(), same_region);
        if (found == soils.end()) {
            faults.push_back(
                {"/section/regions",
                 "has no region \"" + state.regions[r] + "\", to which points of the input belong",
                 "use the scene that the points were made with"});
        }
        match.push_back(static_cast<std::int32_t>(found - soils.begin()));
    }
    if (!faults.empty()) throw fault::BadInput(file, faults);
    return match;
}

/// Refuses effective stress with pore pressure: the solver would lose the pore pressure, and with
/// it equilibrium.
void refuse_water(const exchange::ParticleState& state, const std::string& file) {
    for (std::size_t p = 0; p < state.size(); ++p) {
        if (state.pressure_beside(p) == 0.0) continue;
        throw fault::BadInput(file, {{"/VTKHDF/PointData/pore_pressure",
                                      "points with effective stress and pore pressure",
                                      "transfer total stress (/transfer/stress \"total\")"}});
    }
}

/// Refuses stress of another measure than the run's: with standing water the points of a transfer
/// carry sigma + p I, without it none may.
void refuse_other_measure(const scene::Scene& scene, const exchange::ParticleState& state,
                          const std::string& file) {
    using exchange::StressMeasure;
    const bool wet = scene::mpm_of(scene).water.has_value();
    const bool fits = std::ranges::all_of(state.stress_of_regions, [&](StressMeasure each) {
        return (each == StressMeasure::buoyant) == wet;
    });
    if (fits) return;
    throw fault::BadInput(
        file, {{"/breachline/stress_of_regions",
                wet ? "the points were made without the standing water of /mpm/water"
                    : "the points were made with standing water, and /mpm/water is missing",
                "make the points with this scene: run the transfer again"}});
}

/// [soils] whether its points have individual strengths.
std::vector<bool> strengths_of_points(const scene::Scene& scene) {
    std::vector<bool> have;
    for (const scene::Soil& soil : scene::soils_of(scene))
        have.push_back(materials::has_strength_of_points(scene.materials[soil.material].law));
    return have;
}

/// Calls visit(value of the points, value of the state) for each variable that is copied.
template <class AnyPoints, class AnyState, class Visit>
void for_each_shared(AnyPoints& points, std::size_t p, AnyState& state, std::size_t s,
                     Visit&& visit) {
    visit(points.x[p], state.position[s].x()), visit(points.y[p], state.position[s].y());
    visit(points.vx[p], state.velocity[s].x()), visit(points.vy[p], state.velocity[s].y());
    auto& L = state.velocity_gradient[s];
    visit(points.Lxx[p], L(0, 0)), visit(points.Lxy[p], L(0, 1));
    visit(points.Lyx[p], L(1, 0)), visit(points.Lyy[p], L(1, 1));
    visit(points.m[p], state.mass[s]), visit(points.V_0[p], state.volume_0[s]);
    visit(points.volume[p], state.volume[s]);
    auto& sigma = state.stress[s];
    visit(points.sxx[p], sigma[0]), visit(points.syy[p], sigma[1]);
    visit(points.szz[p], sigma[2]), visit(points.sxy[p], sigma[3]);
    visit(points.epsilon_q[p], state.epsilon_q[s]);
    visit(points.epsilon_q_plastic[p], state.epsilon_q_plastic[s]);
    visit(points.gap[p], state.gap[s]);
    if (points.c.empty()) return;
    auto& strength = state.strength;
    visit(points.c[p], strength.c[s]), visit(points.tan_phi[p], strength.tan_phi[s]);
    visit(points.c_residual[p], strength.c_residual[s]);
    visit(points.tan_phi_residual[p], strength.tan_phi_residual[s]);
}

/// V_0 and V for the stress with the zone's scaled K. What the FEM stretched beyond `loosest` is a
/// gap: an opened crest's few points, at up to 3.6 times their drawn volume, had doubled the steps
/// of Mochikoshi's late runouts.
void settle_volumes(Points& points, Zone& zone, double density) {
    constexpr double loosest = 1.1;  // of the drawn volume
    const double K = zone.elasticity.bulk_modulus();
    for (std::size_t p = zone.begin; p < zone.end; ++p) {
        const double sigma_m = (points.sxx[p] + points.syy[p] + points.szz[p]) / 3.0;
        const double elastic = 1.0 + sigma_m / K;
        const double most = loosest * points.m[p] / density;
        if (zone.volume_rule == VolumeRule::from_stress && points.V_0[p] > most) {
            points.gap[p] += std::log(points.V_0[p] / most);
            points.V_0[p] = most;
        }
        // Stress and volume stay those of the transfer. V_0 is what a softer K must change, or the
        // soil would jump by its elastic compression in the first step.
        if (K != zone.K_drawn) points.V_0[p] *= (1.0 + sigma_m / zone.K_drawn) / elastic;
        if (zone.volume_rule == VolumeRule::from_stress) points.V[p] = points.V_0[p] * elastic;
    }
    zone.largest_specific_volume = largest_specific_volume(points, zone);
}

/// Scales the softening variable like the zone's softening strains.
void scale_softening(Points& points, const Zone& zone) {
    if (zone.softening_scale == 1.0) return;
    for (std::size_t p = zone.begin; p < zone.end; ++p)
        points.epsilon_q_plastic[p] *= zone.softening_scale;
}

/// Refuses points of another thickness than the section.
void refuse_thickness(const scene::Scene& scene, const exchange::ParticleState& state,
                      const std::string& file) {
    // Depths and areas divide volumes by /thickness.
    if (std::abs(state.thickness - scene.thickness) <= 1e-9 * scene.thickness) return;
    throw fault::BadInput(
        file, {{"/VTKHDF",
                "holds points of a slice " + words::text_of(state.thickness) +
                    " m thick, and /thickness is " + words::text_of(scene.thickness) + " m",
                "give the scene the thickness that its points were made with"}});
}

/// [soils] from the solver's scaled quantities to the scene's.
struct Measures {
    double softening;   ///< softening_scale [-]
    double K, K_drawn;  ///< bulk modulus, scaled and in the scene [Pa]
};

/// From the scene and not from the zones: zones have no index by soil, and a material without
/// points has none.
std::vector<Measures> measures_of(const scene::Scene& scene) {
    const scene::Mpm& mpm = scene::mpm_of(scene);
    std::vector<Measures> measures;
    for (const scene::Soil& soil : scene::soils_of(scene)) {
        const scene::Material& material = scene.materials[soil.material];
        measures.push_back({softening_scale(mpm, material),
                            scene::elasticity_in_runout(material, mpm).bulk_modulus(),
                            materials::elasticity(material.law).bulk_modulus()});
    }
    return measures;
}

}  // namespace

double largest_free_viscosity(const mechanics::Elasticity& elasticity, double density,
                              double cell_size) {
    return cells_of_damping * std::sqrt(elasticity.shear_modulus() * density) * cell_size;
}

Damping damping_of(const scene::Scene& scene, const scene::Material& soil,
                   const mechanics::Elasticity& elasticity) {
    const scene::Mpm& mpm = scene::mpm_of(scene);
    if (mpm.damping_ratio == 0.0) return {};
    constexpr double cells_of_limited = 0.05;
    const double impedance = std::sqrt(elasticity.shear_modulus() * soil.density);
    double bound = cells_of_damping * impedance;
    if (mpm.wave_speed_limit)
        bound = std::min(bound, cells_of_limited * soil.density * *mpm.wave_speed_limit);
    const double asked =
        4.0 / std::numbers::pi * mpm.damping_ratio * scene::mobile_height(scene, mpm) * impedance;
    const double viscosity = std::min(asked, bound * mpm.cell_size);
    return {viscosity, asked > 0.0 ? mpm.damping_ratio * viscosity / asked : 0.0};
}

void Points::resize(std::size_t n) {
    for_each_real(*this, [n](const char*, std::vector<double>& values) { values.resize(n); });
    for_each_integer(*this,
                     [n](const char*, std::vector<std::int32_t>& values) { values.resize(n, -1); });
}

void refuse_without_strength(const scene::Scene& scene, const Points& points,
                             const std::string& file) {
    // One strength profile in the scene is enough for the arrays to exist for all points.
    if (!points.c.empty()) return;
    const std::vector<bool> have = strengths_of_points(scene);
    for (std::size_t p = 0; p < points.size(); ++p) {
        if (!have[points.region[p]]) continue;
        const scene::Soil soil = scene::soils_of(scene)[points.region[p]];
        throw fault::BadInput(file,
                              {{"/VTKHDF/PointData/cohesion",
                                "points of \"" + scene.materials[soil.material].name +
                                    "\" have no strengths, and its strength profile asks for them",
                                "make the points with this scene: run the transfer again"}});
    }
}

std::vector<Zone> zones_of(const scene::Scene& scene, const Points& points) {
    const std::vector<scene::Soil> soils = scene::soils_of(scene);
    const auto material_of = [&](std::size_t p) { return soils[points.region[p]].material; };
    std::vector<Zone> zones;
    std::size_t begin = 0;
    for (std::size_t p = 1; p <= points.size(); ++p) {
        const std::size_t material = material_of(begin);
        if (p < points.size() && material_of(p) == material) continue;
        zones.push_back(zone_of(scene, points, material, begin, p));
        begin = p;
    }
    return zones;
}

ZonedPoints zoned_points(const scene::Scene& scene, const exchange::ParticleState& state,
                         const std::string& file) {
    if (state.size() == 0) {
        throw fault::BadInput(file, {{"/", "holds no points", "give at least one"}});
    }
    refuse_water(state, file);
    refuse_other_measure(scene, state, file);
    refuse_thickness(scene, state, file);
    const std::vector<scene::Soil> soils = scene::soils_of(scene);
    const std::vector<std::int32_t> match = match_soils(scene, soils, state, file);
    std::vector<std::size_t> order(state.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto material = [&](std::size_t p) { return soils[match[state.region[p]]].material; };
    // Stable, so that the order within a material follows from the input alone.
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return material(a) < material(b); });

    ZonedPoints result;
    Points& points = result.points;
    points.c.resize(state.strength.c.size());
    points.resize(state.size());
    for (std::size_t p = 0; p < order.size(); ++p) {
        for_each_shared(points, p, state, order[p], [](double& to, double from) { to = from; });
        points.V[p] = points.volume[p];
        points.number[p] = static_cast<std::int32_t>(order[p]);
        points.region[p] = match[state.region[order[p]]];
    }
    if (scene::mpm_of(scene).water) points.displaced = points.volume;
    refuse_without_strength(scene, points, file);
    points.carried.r_u = state.r_u;
    if (!state.stress_of_regions.empty()) {
        points.carried.stress_of_soils.assign(soils.size(), exchange::StressMeasure::effective);
        for (std::size_t r = 0; r < match.size(); ++r) {
            points.carried.stress_of_soils[match[r]] = state.stress_of_regions[r];
        }
    }
    result.zones = zones_of(scene, points);
    for (Zone& zone : result.zones) {
        settle_volumes(points, zone,
                       scene.materials[soils[points.region[zone.begin]].material].density);
        scale_softening(points, zone);
    }
    return result;
}

exchange::ParticleState particle_state(const scene::Scene& scene, const Points& points) {
    const std::size_t n = points.size();
    exchange::ParticleState state;
    state.thickness = scene.thickness;
    state.stress_of_regions = points.carried.stress_of_soils;
    state.r_u = points.carried.r_u;
    for (const scene::Soil& soil : scene::soils_of(scene)) {
        state.regions.push_back(scene.section.regions[soil.region].name);
        state.materials_of_regions.push_back(scene.materials[soil.material].name);
    }
    state.resize(n);
    for (auto* values : {&state.strength.c, &state.strength.tan_phi, &state.strength.c_residual,
                         &state.strength.tan_phi_residual})
        values->resize(points.c.size());
    const std::vector<Measures> measures = measures_of(scene);
    for (std::size_t p = 0; p < n; ++p) {
        const auto to = static_cast<std::size_t>(points.number[p]);
        const Measures& of = measures[points.region[p]];
        for_each_shared(points, p, state, to, [](double from, double& there) { there = from; });
        const double sigma_m = (points.sxx[p] + points.syy[p] + points.szz[p]) / 3.0;
        if (of.K != of.K_drawn)
            state.volume_0[to] *= (1.0 + sigma_m / of.K) / (1.0 + sigma_m / of.K_drawn);
        state.epsilon_q_plastic[to] /= of.softening;
        state.region[to] = points.region[p];
    }
    return state;
}

}  // namespace breach::mpm
