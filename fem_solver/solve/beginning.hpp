// State at the beginning of the first dynamic stage: reference of r_u, reaction of the base, motion
// of the free field.
// begin_motion (begin_stage.cpp) makes it once per run; snapshots, monitors and the base's force
// refer to it until the end.
#pragma once

#include "core/exchange/base_motion.hpp"
#include "fem_solver/model/model.hpp"

namespace breach::fem {

/// Empty before that stage.
struct Beginning {
    /// reaction of the base in x, then a constant force, per dof; empty without elastic base [N]
    Eigen::VectorXd base_reaction;
    Eigen::VectorXd p;  ///< u_0, per node; empty if dry [Pa]
    /// vertical effective stress, per node of the body, compression positive; empty if dry [Pa]
    std::vector<double> sigma_v0;
    /// the same per Gauss point of the body; empty if dry and no law has a state parameter [Pa]
    std::vector<double> sigma_v0_points;
    std::vector<double> s_u;               ///< Model::s_u [Pa]
    std::vector<double> skeleton_modulus;  ///< of the saturated elements, K + 4G/3 [Pa]
    exchange::BaseMotion base_motion{};    ///< of the free-field columns (base_motion.hpp)
};

Beginning beginning_of(const Model& model, const Motion& motion);

/// Sets the undrained strengths and the modulus of the pressure stabilisation to these values.
/// Again after each rebuilding of the water and after a restart: a Model alone has elastic moduli.
void apply_to_model(const Beginning& beginning, Model& model);

/// Coefficient of lateral stress sigma'_xx / sigma'_yy: volume average over the body [-], and its
/// range over elements with at least 1 % of the largest sigma'_yy.
struct LateralStress {
    double average = 0.0;
    double least = 0.0;
    double largest = 0.0;
};
LateralStress lateral_stress(const Model& model, const Motion& motion);

}  // namespace breach::fem
