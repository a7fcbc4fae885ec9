// The dashpots of a Lysmer-Kuhlemeyer base and its input motion.
// Made once by build_model. Dashpots enter the matrix and the residual (newton.cpp), the motion
// enters as a force (set_external_force).
#pragma once

#include "core/motion/read_motion.hpp"
#include "core/scene/scene.hpp"
#include "fem_solver/model/model.hpp"

namespace breach::fem {

/// Dashpots at all base nodes, each for half of its adjacent edges; `impedance` = rho V_s of the
/// rock [Pa s/m].
AbsorbingBase absorbing_base(const Model& model, double impedance, motion::Series velocity,
                             scene::MotionAt at);

/// Velocity of the input motion.
motion::Series base_velocity(const scene::BaseMotion& wanted);

}  // namespace breach::fem
