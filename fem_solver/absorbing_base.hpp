// Lysmer-Kuhlemeyer base: an elastic half-space below the mesh, as dashpots and forces on its lower
// edge.
#pragma once

#include "core/motion/series.hpp"
#include "fem_solver/model.hpp"

namespace breach::fem {

/// What the velocity is that comes with a motion.
enum class MotionAt {
    outcrop,  ///< of the rock's free surface: twice the up-going wave
    upgoing,  ///< the up-going wave alone
};

/// Shear traction on the base: rho V_s (2 w - v), w the up-going velocity, v the base's own (Lysmer
/// & Kuhlemeyer 1969, Joyner & Chen 1975). An outcrop motion is 2 w, so its force is c v_outcrop,
/// once, not twice. A motion recorded *within* the ground must not be used here.
struct AbsorbingBase {
    Eigen::VectorXd dashpot;  ///< c = rho V_s A per dof, x of the base's nodes [N s/m]
    motion::Series outcrop;   ///< outcrop velocity [m/s]

    /// Adds the force at time t [s] to f [N].
    void add_force(double t, Eigen::VectorXd& f) const {
        f += motion::value_at(outcrop, t) * dashpot;
    }
};

/// All nodes at the mesh's lowest level; `impedance` = rho V_s of the rock [Pa s/m]. Each node has
/// half of its neighbouring edges.
AbsorbingBase absorbing_base(const Model& model, double impedance, motion::Series velocity,
                             MotionAt at);

}  // namespace breach::fem
