// Requirements of the MPM's law on a transferred stress: inside or on the yield surface, and a
// reference volume.
#pragma once

#include <span>
#include <vector>

#include "core/exchange/mesh_snapshot.hpp"
#include "core/exchange/particle_state.hpp"
#include "core/scene/scene.hpp"
#include "transfer_tool/soils.hpp"

namespace breach::transfer {

std::vector<materials::Law> laws_of(std::span<const SoilOfPoints> soils);

/// Points of one soil found outside the yield surface by more than round-off.
struct YieldShare {
    std::size_t returned = 0;
    double mass = 0.0;            ///< theirs [kg]
    double largest_excess = 0.0;  ///< how far outside [Pa]
    Vec2 place = Vec2::Zero();    ///< of that one
};
using YieldReport = std::vector<YieldShare>;  ///< [soils]

/// zero: softening starts at 0. carried: if the law softens with total strain it starts at the
/// FEM's epsilon_q, otherwise at epsilon_q_plastic.
void start_softening(scene::SofteningStart start, std::span<const materials::Law> laws,
                     exchange::ParticleState& state);

/// Start of the softening in one soil.
struct SofteningShare {
    std::size_t soil = 0;
    materials::SofteningDriver driver = materials::SofteningDriver::plastic;
    double mean = 0.0;     ///< by mass [-]
    double largest = 0.0;  ///< [-]
};
/// Soils that soften and have points.
std::vector<SofteningShare> softening_of(std::span<const materials::Law> laws,
                                         const exchange::ParticleState& state);

/// Returns stresses outside the law's yield surface, at the strength for epsilon_q_plastic, to it
/// by the law's own return. The plastic strain of that return is due to the interpolation, not to
/// the soil, and is discarded.
YieldReport return_to_yield_surface(std::span<const materials::Law> laws,
                                    exchange::ParticleState& state);

/// volume_0 = volume / (1 + sigma_m / K), the volume at zero mean stress by the MPM's V = V_0 (1 +
/// sigma_m / K). Throws Breakdown where the stress compresses to nothing (sigma_m <= -K).
void find_reference_volumes(std::span<const materials::Law> laws, exchange::ParticleState& state);

}  // namespace breach::transfer
