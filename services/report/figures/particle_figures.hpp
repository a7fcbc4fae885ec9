// Pictures of material points: coloured by what they are, or by a value.
#pragma once

#include "core/exchange/particle_state.hpp"
#include "services/report/chart/figure.hpp"

namespace breach::report {

/// One colour per material; at most about 15,000 points are drawn, evenly picked, which the caption
/// says. The data hold those that are drawn.
Figure points_by_material(const exchange::ParticleState& state, const std::string& name,
                          const std::string& title);
/// By epsilon_q [%], in the same way.
Figure points_by_strain(const exchange::ParticleState& state, const std::string& name,
                        const std::string& title);

}  // namespace breach::report
