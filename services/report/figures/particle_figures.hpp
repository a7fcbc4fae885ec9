// Pictures of material points: coloured by material or by a value.
#pragma once

#include "core/exchange/particle_state.hpp"
#include "services/report/chart/figure.hpp"

namespace breach::report {

/// One colour per material. Draws at most about 15,000 points, evenly picked, as the caption says;
/// the data contain the drawn points.
Figure points_by_material(const exchange::ParticleState& state, const std::string& name,
                          const std::string& title);
/// Coloured by epsilon_q [%], otherwise the same.
Figure points_by_strain(const exchange::ParticleState& state, const std::string& name,
                        const std::string& title);

}  // namespace breach::report
