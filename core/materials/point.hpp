// State of a material point, result of a law for a strain increment, and the elastic step of all
// laws.
#pragma once

#include "core/materials/lane_law.hpp"
#include "core/mechanics/elasticity.hpp"
#include "core/mechanics/tensor.hpp"

namespace breach::materials {

using mechanics::Matrix4;
using mechanics::Voigt;

/// State of a point. epsilon_q accumulates sqrt(2/3 de:de) of the strain that drives softening
/// (plastic unless the law says total).
struct State {
    Voigt sigma;             ///< effective stress [Pa]
    double epsilon_q = 0.0;  ///< accumulated equivalent deviatoric strain [-]
};

/// Where on the yield surface a return ended.
enum class Return { elastic, plane, edge_major, edge_minor, apex, tension };

struct Update {
    State state;
    Voigt d_epsilon_plastic;  ///< plastic strain of the increment, engineering shear [-]
    Return kind;
};

/// Strength at a given softening.
struct Strength {
    double c;        ///< [Pa]
    double tan_phi;  ///< [-]
};

/// Which epsilon_q drives softening: plastic deviatoric strain, or total deviatoric strain.
enum class SofteningDriver { plastic, total };

/// c and tan(phi) fall linearly from their peak at `start` to the residual values at `end` (Sordo
/// et al. 2024).
struct Softening {
    double epsilon_q_start;   ///< [-]
    double epsilon_q_end;     ///< [-], > start
    double c_residual;        ///< [Pa]
    double tan_phi_residual;  ///< [-]
    SofteningDriver driver = SofteningDriver::plastic;
};

inline Moduli make_moduli(const mechanics::Elasticity& elasticity) {
    const double G = elasticity.shear_modulus();
    const double K = elasticity.bulk_modulus();
    return {G, K, K - 2.0 / 3.0 * G};
}

/// D with sigma = D epsilon [Pa]; the same bits as mechanics::elastic_stiffness.
inline Matrix4 elastic_stiffness(const Moduli& moduli) {
    Matrix4 D = Matrix4::Zero();
    D.topLeftCorner<3, 3>().setConstant(moduli.lambda);
    D.topLeftCorner<3, 3>().diagonal().array() += 2.0 * moduli.G;
    D(3, 3) = moduli.G;
    return D;
}

inline Voigt trial_stress(const Moduli& moduli, const Voigt& sigma, const Voigt& d_epsilon) {
    const double volumetric = moduli.lambda * (d_epsilon[0] + d_epsilon[1] + d_epsilon[2]);
    return {sigma[0] + volumetric + 2.0 * moduli.G * d_epsilon[0],
            sigma[1] + volumetric + 2.0 * moduli.G * d_epsilon[1],
            sigma[2] + volumetric + 2.0 * moduli.G * d_epsilon[2],
            sigma[3] + moduli.G * d_epsilon[3]};
}

}  // namespace breach::materials
