#include "fem_solver/model/ssp_quad.hpp"

namespace breach::fem {

void evaluate_ssp(const Corners& x, double thickness, SspGeometry& out) {
    Gradient natural;                     // at xi = eta = 0
    natural << -0.25, 0.25, 0.25, -0.25,  //
        -0.25, -0.25, 0.25, 0.25;
    const Eigen::Vector4d h(1.0, -1.0, 1.0, -1.0);
    const Matrix2 J = natural * x.transpose();
    const double J_0 = J(0, 0) * J(1, 1) - J(0, 1) * J(1, 0);
    Matrix2 inverse;  // rows d/dx, d/dy; columns xi, eta
    inverse << J(1, 1), -J(0, 1), -J(1, 0), J(0, 0);
    inverse /= J_0;
    out.dN.noalias() = inverse * natural;
    // The linear part is taken out of h: rigid motion and uniform strain have no hourglass
    // amplitude.
    out.gamma = 0.25 * (h - out.dN.transpose() * (x * h));
    out.volume = 4.0 * J_0 * thickness;
    const Vec2 d_x = inverse.row(0), d_y = inverse.row(1);
    const double cross = d_x.dot(d_y);
    out.H << d_x.squaredNorm(), -cross, -cross, d_y.squaredNorm();
    out.H *= J_0 * thickness / 3.0;
}

StrainOperator centre_strain_operator(const Gradient& dN) {
    StrainOperator B = StrainOperator::Zero();
    for (int i = 0; i < 4; ++i) {
        B(0, 2 * i) = B(2, 2 * i + 1) = dN(0, i);
        B(1, 2 * i + 1) = B(2, 2 * i) = dN(1, i);
    }
    return B;
}

void use_centre_only(const SspGeometry& geometry, Gradients& gradients, Quadrature& quadrature) {
    for (std::size_t g = 0; g < gauss_points; ++g) {
        gradients.dN[g].setZero();
        gradients.weight[g] = quadrature.weight[g] = 0.0;
        quadrature.B[g].setZero();
    }
    gradients.dN[0] = geometry.dN;
    gradients.weight[0] = quadrature.weight[0] = geometry.volume;
    quadrature.B[0] = centre_strain_operator(geometry.dN);
}

Stiffness hourglass_stiffness(const SspGeometry& geometry, double c_s) {
    Stiffness K;
    for (int j = 0; j < 4; ++j) {
        for (int i = 0; i < 4; ++i) {
            K.block<2, 2>(2 * i, 2 * j) =
                (c_s * geometry.gamma[i] * geometry.gamma[j]) * geometry.H;
        }
    }
    return K;
}

Dofs8 hourglass_forces(const SspGeometry& geometry, const Vec2& Q) {
    Dofs8 f;
    for (int i = 0; i < 4; ++i) f.segment<2>(2 * i) = geometry.gamma[i] * Q;
    return f;
}

Vec2 hourglass_amplitude(const SspGeometry& geometry, const Dofs8& u) {
    return Eigen::Map<const Corners>(u.data()) * geometry.gamma;
}

}  // namespace breach::fem
