// The dashpots of a Lysmer-Kuhlemeyer base on this mesh, and its input motion.
#pragma once

#include "core/motion/read_motion.hpp"
#include "core/scene/scene.hpp"
#include "fem_solver/model/model.hpp"

namespace breach::fem {

/// All nodes of the mesh's base; `impedance` = rho V_s of the rock [Pa s/m]. Each node has half of
/// its neighbouring edges.
AbsorbingBase absorbing_base(const Model& model, double impedance, motion::Series velocity,
                             scene::MotionAt at);

/// Velocity of the input motion.
motion::Series base_velocity(const scene::BaseMotion& wanted);

}  // namespace breach::fem
