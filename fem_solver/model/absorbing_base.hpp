// Lysmer-Kuhlemeyer base: an elastic half-space below the mesh, as dashpots and forces on its lower
// edge.
#pragma once

#include <Eigen/Core>

#include "core/motion/read_motion.hpp"
#include "core/scene/scene.hpp"

namespace breach::fem {

struct Model;

/// Shear traction on the base: rho V_s (2 w - v), w the up-going velocity, v the base's own (Lysmer
/// & Kuhlemeyer 1969, Joyner & Chen 1975). An outcrop motion is 2 w, so its force is c v_outcrop,
/// once, not twice. A motion recorded *within* the ground must not be used here.
struct AbsorbingBase {
    Eigen::VectorXd dashpot;  ///< c = rho V_s A per dof, x of the base's nodes; empty: no base
                              ///< [N s/m]
    motion::Series outcrop;   ///< outcrop velocity; empty: rest [m/s]

    bool any() const { return dashpot.size() > 0; }
    /// Adds the force at time t [s] to f [N].
    void add_force(double t, Eigen::VectorXd& f) const {
        if (!outcrop.values.empty()) f += motion::value_at(outcrop, t) * dashpot;
    }
};

/// All nodes of the mesh's base; `impedance` = rho V_s of the rock [Pa s/m]. Each node has half of
/// its neighbouring edges.
AbsorbingBase absorbing_base(const Model& model, double impedance, motion::Series velocity,
                             scene::MotionAt at);

/// Velocity that the motion brings.
motion::Series base_velocity(const scene::BaseMotion& wanted);

}  // namespace breach::fem
