// What the MPM's law asks of a transferred stress: that it lies on or inside the yield surface, and
// a reference volume.
#pragma once

#include <span>
#include <vector>

#include "core/exchange/mesh_snapshot.hpp"
#include "core/exchange/particle_state.hpp"
#include "core/scene/scene.hpp"

namespace breach::transfer {

/// The law of each region of the snapshot, matched by region name. Throws BadInput when the scene
/// lacks a region or gives it another material than the snapshot does.
std::vector<materials::Law> laws_of_regions(const exchange::MeshSnapshot& mesh,
                                            const scene::Scene& scene, const std::string& file);

struct YieldReport {
    std::size_t returned = 0;     ///< points found outside the yield surface by more than round-off
    double largest_excess = 0.0;  ///< how far outside [Pa]
};

/// carried: keeps epsilon_q_plastic; zero: softening starts anew.
void start_softening(scene::SofteningStart start, exchange::ParticleState& state);

/// Puts stresses outside the law's yield surface, at the strength that belongs to
/// epsilon_q_plastic, back on it with the law's own return. The plastic strain of that return is
/// the interpolation's, not the soil's, and is not kept.
YieldReport return_to_yield_surface(std::span<const materials::Law> laws,
                                    exchange::ParticleState& state);

/// volume_0 = volume / (1 + sigma_m / K), the volume at zero mean stress by the MPM's V = V_0 (1 +
/// sigma_m / K). Throws Breakdown where the stress compresses to nothing (sigma_m <= -K).
void find_reference_volumes(std::span<const materials::Law> laws, exchange::ParticleState& state);

}  // namespace breach::transfer
