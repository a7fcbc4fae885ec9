// The energy budget of a run.
#pragma once

#include "mpm_solver/body/body.hpp"

namespace breach::mpm {

/// Energies of the points now, and dissipation so far [J].
struct Energy {
    double kinetic = 0.0;
    double gravitational = 0.0;  ///< against y = 0
    double elastic = 0.0;
    double plastic = 0.0;   ///< dissipated by plastic strain
    double friction = 0.0;  ///< dissipated by the floor's friction
    double viscous = 0.0;   ///< dissipated by viscosity
    double shaking = 0.0;   ///< added by the moving frame's force; negative: removed
};

Energy energy_of(const Body& body);

/// Loss without a physical cause [J]: positive when the scheme lost energy, negative when it
/// created some.
double numerical_loss(const Energy& start, const Energy& now);

/// Potential energy released since the start, plus kinetic energy at the start and the energy that
/// the shaking added since [J].
double released(const Energy& start, const Energy& now);

/// numerical_loss / released; 0 while nothing has been released.
double numerical_share(const Energy& start, const Energy& now);

/// Kinetic energy [J] and mass [kg] of the points of these soils.
double kinetic_energy_of(const Points& points, const std::vector<std::uint8_t>& counts);
double mass_of(const Points& points, const std::vector<std::uint8_t>& counts);

/// Volume of the soil of these regions (followed through every strain increment) [m3]; an empty
/// list counts all.
double volume_of(const Points& points, const std::vector<std::uint8_t>& counts);

}  // namespace breach::mpm
