// What the MPM's laws require of transferred points: stress inside the yield surface, and a
// reference volume.
// transfer.cpp calls them in the order start_softening, return_to_yield_surface,
// find_reference_volumes: each needs the one before.
#pragma once

#include <span>
#include <vector>

#include "core/exchange/mesh_snapshot.hpp"
#include "core/exchange/particle_state.hpp"
#include "core/scene/scene.hpp"
#include "transfer_tool/soils.hpp"

namespace breach::transfer {

std::vector<materials::Law> laws_of(std::span<const SoilOfPoints> soils);

/// Points of one soil outside the yield surface by more than round-off.
struct YieldShare {
    std::size_t returned = 0;
    double mass = 0.0;            ///< of these points [kg]
    double largest_excess = 0.0;  ///< largest distance from the surface [Pa]
    Vec2 place = Vec2::Zero();    ///< of the largest excess
};
using YieldReport = std::vector<YieldShare>;  ///< [soils]

/// The softening variable starts at the FEM's epsilon_q if the law softens with total strain, else
/// at epsilon_q_plastic.
void start_softening(std::span<const materials::Law> laws, exchange::ParticleState& state);

/// Softening variable of one soil at the start.
struct SofteningShare {
    std::size_t soil = 0;
    materials::SofteningDriver driver = materials::SofteningDriver::plastic;
    double mean = 0.0;     ///< mass average [-]
    double largest = 0.0;  ///< [-]
};
/// For soils that soften and have points.
std::vector<SofteningShare> softening_of(std::span<const materials::Law> laws,
                                         const exchange::ParticleState& state);

/// Returns stresses outside the yield surface (with the strength for epsilon_q_plastic) to it, by
/// the law's return mapping. The plastic strain of that return comes from interpolation and is
/// discarded.
YieldReport return_to_yield_surface(std::span<const materials::Law> laws,
                                    exchange::ParticleState& state);

/// volume_0 = volume / (1 + sigma_m / K): the volume at zero mean stress in the MPM's V = V_0 (1 +
/// sigma_m / K). Throws Breakdown if sigma_m <= -K.
void find_reference_volumes(std::span<const materials::Law> laws, exchange::ParticleState& state);

}  // namespace breach::transfer
