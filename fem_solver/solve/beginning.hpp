// The state at the beginning of the first dynamic stage: the reference of r_u, the forces that held
// the base until then, and the motion of the free ground.
#pragma once

#include "core/exchange/base_motion.hpp"
#include "fem_solver/model/model.hpp"

namespace breach::fem {

/// All empty before that moment.
struct Beginning {
    Eigen::VectorXd base_reaction;         ///< what held the base in x, from then on a constant
                                           ///< force, per dof; empty without an elastic base [N]
    Eigen::VectorXd p;                     ///< pore pressure u_0, per node; empty when dry [Pa]
    std::vector<double> sigma_v0;          ///< vertical effective stress, per node of the body,
                                           ///< compression positive; empty when dry [Pa]
    std::vector<double> sigma_v0_points;   ///< the same per Gauss point of the body, dry or not;
                                           ///< empty where no law has a state parameter [Pa]
    std::vector<double> skeleton_modulus;  ///< of the saturated elements, K + 4G/3 [Pa]
    exchange::BaseMotion base_motion{};    ///< of the free-field columns alone (base_motion.hpp)
};

Beginning beginning_of(const Model& model, const Motion& motion);

/// Sets the modulus in the pressure stabilisation to that at the beginning.
void set_skeleton_modulus(const Beginning& beginning, Model& model);

/// Coefficient of lateral stress sigma'_xx / sigma'_yy, volume average over the body [-], and its
/// least and largest value among elements that carry at least a hundredth of the largest sigma'_yy.
struct LateralStress {
    double average = 0.0;
    double least = 0.0;
    double largest = 0.0;
};
LateralStress lateral_stress(const Model& model, const Motion& motion);

}  // namespace breach::fem
