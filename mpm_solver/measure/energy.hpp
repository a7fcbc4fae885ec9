// The energy budget of a run.
// The best single sign of a sound run: a deposit can look smooth while the scheme took a quarter of
// the energy. Computed at each measurement; the dissipations come from Body::tally, step by step.
#pragma once

#include "mpm_solver/body/body.hpp"

namespace breach::mpm {

/// Present energies of the points, and dissipation so far [J].
struct Energy {
    double kinetic = 0.0;
    double gravitational = 0.0;  ///< relative to y = 0; with V p of standing water
    double elastic = 0.0;
    double plastic = 0.0;   ///< dissipated by plastic strain
    double friction = 0.0;  ///< dissipated by the floor's friction
    double viscous = 0.0;   ///< dissipated by viscosity
    double shaking = 0.0;   ///< added by the moving frame; negative: removed
};

Energy energy_of(const Body& body);

/// Energy without physical cause [J]: positive if the scheme lost energy, negative if it created
/// some.
double numerical_loss(const Energy& start, const Energy& now);

/// Potential energy released since the start, plus initial kinetic energy, plus energy added by the
/// shaking [J].
double released(const Energy& start, const Energy& now);

/// Kinetic energy [J] and mass [kg] of the points of these soils.
double kinetic_energy_of(const Points& points, const std::vector<std::uint8_t>& counts);
double mass_of(const Points& points, const std::vector<std::uint8_t>& counts);

/// Mean x of their mass [m]; 0 without mass.
double mean_x_of(const Points& points, const std::vector<std::uint8_t>& counts);

/// Volume of the soil of these regions, integrated from the strain increments [m3]; an empty list
/// counts all.
double volume_of(const Points& points, const std::vector<std::uint8_t>& counts);

}  // namespace breach::mpm
