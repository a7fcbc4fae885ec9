// Share of damping in the stress of a failure band. If it is large, viscosity that the soil does
// not have slows the slide.
// Recorder reads it per row; report_end flags its largest value.
#pragma once

#include "fem_solver/model/model.hpp"

namespace breach::fem {

/// Above this: flag `viscous_band`.
inline constexpr double largest_viscous_share = 1.0 / 3.0;

/// Shear stress of the stiffness-proportional damping, beta G d_gamma/dt, over that of the soil
/// [-], weighted by shear rate and volume over elements with epsilon_q above `threshold`; 0 if
/// there are none, or no such damping.
double viscous_share(const Model& model, const Motion& motion, double threshold);

}  // namespace breach::fem
