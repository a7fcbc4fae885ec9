// Pictures of material points: coloured by material or by a value.
#pragma once

#include "core/exchange/particle_state.hpp"
#include "services/report/chart/figure.hpp"

namespace breach::report {

/// One colour per material; draws at most about 15,000 points, evenly picked, as the caption says.
/// The data contain the drawn points.
Figure points_by_material(const exchange::ParticleState& state, const std::string& name,
                          const std::string& title);
/// By epsilon_q [%], in the same way.
Figure points_by_strain(const exchange::ParticleState& state, const std::string& name,
                        const std::string& title);

}  // namespace breach::report
