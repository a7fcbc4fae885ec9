// The points' soils, strengths and stresses, from what the snapshot's places have.
// SoilMap is built first in transfer.cpp, so that a scene that does not match its snapshot is
// refused before the costly interpolation. Asked for every point, and by the ledger for every Gauss
// point.
#pragma once

#include "core/liquefied/soil_map.hpp"
#include "transfer_tool/points.hpp"

namespace breach::transfer {

using liquefied::Collapse;
using liquefied::LiquefiedGap;
using liquefied::SoilMap;
using liquefied::SoilOfPoints;

/// Counts of points in soil with strengths by state, for result.json and messages.
struct CollapseReport {
    double epsilon_q;           ///< strain above which soil counts as strained
    std::size_t points = 0;     ///< of these regions
    std::size_t saturated = 0;  ///< of these, with strengths by state
    std::size_t past_line = 0;  ///< of these, past the instability line
    std::size_t collapsed = 0;  ///< of these, strained too: residual strength from the start
    double mass = 0.0;          ///< collapsed [kg]
};

/// None if there is no such soil.
std::optional<CollapseReport> collapse_report(const SoilMap& map, const Points& points);

/// Assigns a soil to every point: state.region and the lists it refers to.
void assign_soils(const SoilMap& map, Points& points);

/// Resets the softening variable of soil with a peak strength from its present state: until it has
/// collapsed, it softens with further strain only. Call after start_softening.
void start_at_state(const SoilMap& map, Points& points);

/// From the effective stress: sigma' - u I for points with total stress, sigma' + (p - u) I for
/// buoyant ones at the pressure p of the standing water there.
mechanics::Voigt stress_of(const SoilOfPoints& soil, const mechanics::Voigt& sigma_effective,
                           double u, double p);
void settle_stress(const SoilMap& map, Points& points);

/// Points of one soil, for result.json and messages.
struct SoilShare {
    std::size_t soil;
    std::size_t points = 0;
    double mass = 0.0;  ///< [kg]
};
/// Only soils with points.
std::vector<SoilShare> shares_of_soils(const SoilMap& map, const exchange::ParticleState& state);

}  // namespace breach::transfer
