// The material points as structure of arrays, ordered by zone: the points with one law.
// Sorting permutes all arrays within their zone; `number` leads back to the input, whose order all
// outputs and Carried keep.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "core/exchange/particle_state.hpp"
#include "core/scene/scene.hpp"
#include "mpm_solver/loops/loops.hpp"

namespace breach::mpm {

/// Data for the outputs that steps do not use.
struct Carried {
    std::vector<exchange::StressMeasure> stress_of_soils;  ///< [soils_of(scene)]; empty: effective
    std::vector<double> r_u;  ///< at the transfer, in the order of the input; empty if dry
};

using Reals = std::vector<double>;

struct Points : PointReals<Reals> {
    std::vector<std::int32_t> region;  ///< index into soils_of(scene)
    std::vector<std::int32_t> number;  ///< index in the input; outputs have its order
    std::vector<std::int32_t> home;    ///< nearest node at the last sort
    std::vector<std::int32_t> cell;    ///< cell at the start of the step, for anti-locking

    Carried carried;

    std::size_t size() const { return x.size(); }
    /// Volume without cracks from tension, for depths [m3].
    double soil_volume(std::size_t p) const { return volume[p] * std::exp(-gap[p]); }
    void resize(std::size_t n);
};

/// Calls visit(name, array) for every array of reals that outlives a step, for checkpoints and
/// sorting.
template <class AnyPoints, class Visit>
void for_each_real(AnyPoints& points, Visit&& visit) {
    for (const auto& real : reals_of_points<Reals>) {
        const bool there = !real.only_with || !(points.*real.only_with).empty();
        if (there && real.life != Life::step) visit(real.name, points.*real.array);
    }
}

template <class AnyPoints, class Visit>
void for_each_integer(AnyPoints& points, Visit&& visit) {
    visit("region", points.region), visit("number", points.number), visit("home", points.home);
}

/// Points [begin, end) of one material.
struct Zone {
    std::string material;
    materials::Law law;         ///< with scaled E and softening strains
    materials::LawLanes lanes;  ///< the same for the loops
    mechanics::Elasticity elasticity;
    double K_drawn;  ///< bulk modulus in the scene [Pa]
    VolumeRule volume_rule;
    double softening_scale;  ///< scale of the softening strains of law and points [-]
    double viscosity;        ///< eta [Pa s]
    double damping;          ///< additional viscosity of soil that does not yield [Pa s]
    double nonlocal_length;  ///< of softening; 0: local [m]
    WallRows walls_y;        ///< of the floor, and of the top of a bed (core/scene/beds.hpp)
    std::size_t begin;
    std::size_t end;
    double largest_specific_volume = 0.0;  ///< max V / m, for the wave speed [m3/kg]
};

/// Largest viscosity that does not reduce the time step of an elastic soil (courant_step) [Pa s].
double largest_free_viscosity(const mechanics::Elasticity& elasticity, double density,
                              double cell_size);

/// Damping of soil that does not yield.
struct Damping {
    double viscosity = 0.0;  ///< [Pa s]
    double ratio = 0.0;      ///< of critical, in force; /mpm/damping_ratio at most [-]
};

/// Viscosity 2 xi G / omega: damps the fundamental shear wave of the mobile soil's height H, omega
/// = pi c_s / (2 H), with the ratio xi; at most largest_free_viscosity. If the wave speed is
/// limited, c_s is near that limit and the bound is lower.
Damping damping_of(const scene::Scene& scene, const scene::Material& soil,
                   const mechanics::Elasticity& elasticity);

/// Input of make_body: at the start from zoned_points, from a checkpoint with zones_of.
struct ZonedPoints {
    Points points;
    std::vector<Zone> zones;
};

/// Points of a particle state, grouped by material; matches regions by name. The stiffness scale
/// changes K: then V_0 is recomputed, and the volume stays. Throws BadInput with `file`.
ZonedPoints zoned_points(const scene::Scene& scene, const exchange::ParticleState& state,
                         const std::string& file);

/// Throws BadInput with `file` if points lack the individual strengths that their soil needs.
void refuse_without_strength(const scene::Scene& scene, const Points& points,
                             const std::string& file);

/// The zones, for points that are already grouped (a checkpoint).
std::vector<Zone> zones_of(const scene::Scene& scene, const Points& points);

/// Converts to the exchange's form, in the order of the input.
exchange::ParticleState particle_state(const scene::Scene& scene, const Points& points);

}  // namespace breach::mpm
