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

/// The scene's motion as it is applied: read, scaled, its baseline corrected if asked for; an
/// acceleration or a velocity. Throws BadInput for what cannot be used as such.
motion::Recording applied_motion(const scene::BaseMotion& wanted);
/// Largest acceleration [m/s2] and velocity [m/s] of a motion given as either.
struct MotionPeaks {
    double acceleration;
    double velocity;
};
MotionPeaks peaks_of(const motion::Recording& motion);
/// Velocity that it brings; warns of one that is left at its end.
motion::Series base_velocity(const scene::BaseMotion& wanted);

}  // namespace breach::fem
