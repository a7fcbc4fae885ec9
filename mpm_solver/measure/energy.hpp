// The energy budget: where the energy that was released has gone.
#pragma once

#include "mpm_solver/body/body.hpp"

namespace breach::mpm {

/// Energies of the points now, and what was dissipated so far [J].
struct Energy {
    double kinetic = 0.0;
    double gravitational = 0.0;  ///< against y = 0
    double elastic = 0.0;
    double plastic = 0.0;   ///< dissipated by plastic strain
    double friction = 0.0;  ///< dissipated by the floor's friction
    double viscous = 0.0;   ///< dissipated by viscosity
    double shaking = 0.0;   ///< put in by the moving frame's force; negative: taken out
};

Energy energy_of(const Body& body);

/// Loss that no physics accounts for [J]: positive when the scheme took energy, negative when it
/// gave.
double numerical_loss(const Energy& start, const Energy& now);

/// Potential energy released since the start, kinetic energy brought along at the start and what the
/// shaking put in since [J].
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
