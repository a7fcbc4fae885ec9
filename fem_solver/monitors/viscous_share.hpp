// Share of damping in the stress of a failing band: with a large one the slide is slowed by a
// viscosity that the soil does not have.
#pragma once

#include "fem_solver/model/model.hpp"

namespace breach::fem {

/// Above this: flag `viscous_band`.
inline constexpr double largest_viscous_share = 1.0 / 3.0;

/// Shear stress of the stiffness-proportional damping, beta G d_gamma/dt, over the soil's own, both
/// weighed by shear rate and volume over the body's elements whose epsilon_q is above `threshold`
/// [-]; 0 where none is, and without such damping.
double viscous_share(const Model& model, const Motion& motion, double threshold);

}  // namespace breach::fem
