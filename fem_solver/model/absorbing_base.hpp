// The dashpots of a Lysmer-Kuhlemeyer base on this mesh, and the motion that comes through them.
#pragma once

#include "core/motion/read_motion.hpp"
#include "core/scene/scene.hpp"
#include "fem_solver/model/model.hpp"

namespace breach::fem {

/// All nodes of the mesh's base; `impedance` = rho V_s of the rock [Pa s/m]. Each node has half of
/// its neighbouring edges.
AbsorbingBase absorbing_base(const Model& model, double impedance, motion::Series velocity,
                             scene::MotionAt at);

/// Velocity that the motion brings.
motion::Series base_velocity(const scene::BaseMotion& wanted);

}  // namespace breach::fem
