#include "fem_solver/solve/viscosity.hpp"

namespace breach::fem {
namespace {

/// (xx, yy, xy) of 2 eta dev D over eta, from (D_xx, D_yy, 2 D_xy).
const Eigen::Matrix3d& of_unit_viscosity() {
    static const Eigen::Matrix3d D = [] {
        Eigen::Matrix3d m;
        m << 4.0 / 3.0, -2.0 / 3.0, 0.0,  //
            -2.0 / 3.0, 4.0 / 3.0, 0.0,   //
            0.0, 0.0, 1.0;
        return m;
    }();
    return D;
}

}  // namespace

Dofs8 viscous_forces(const ElementOperators& element, double eta, const Dofs8& v) {
    Dofs8 f = Dofs8::Zero();
    for (std::size_t g = 0; g < element.points; ++g) {
        const StrainOperator& B = element.quadrature.B[g];
        const Eigen::Vector3d rate = B * v;
        const Eigen::Vector3d s =
            (eta * element.quadrature.weight[g]) * (of_unit_viscosity() * rate);
        f.noalias() += B.transpose() * s;
    }
    if (element.hourglass == nullptr) return f;
    const Vec2 q_rate = hourglass_amplitude(*element.hourglass, v);
    // One point does not see the hourglass modes: they flow with 4 eta where elasticity has 4 G.
    return f + hourglass_forces(*element.hourglass, 4.0 * eta * (element.hourglass->H * q_rate));
}

Stiffness viscous_damping(const ElementOperators& element, double eta) {
    Stiffness C = Stiffness::Zero();
    for (std::size_t g = 0; g < element.points; ++g) {
        const StrainOperator& B = element.quadrature.B[g];
        const StrainOperator DB = (eta * element.quadrature.weight[g]) * (of_unit_viscosity() * B);
        C.noalias() += B.transpose() * DB;
    }
    if (element.hourglass != nullptr) C += hourglass_stiffness(*element.hourglass, 4.0 * eta);
    return C;
}

}  // namespace breach::fem
