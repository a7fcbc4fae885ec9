// The stabilised single-point quad (McGann, Arduino & Mackenzie-Helnwein 2012): one material point
// at the centre, and an assumed deviatoric strain for the two hourglass modes.
// Symbols and equations: docs/reference/methods/up_element.md, sections 2 and 3.
#pragma once

#include "fem_solver/model/element.hpp"

namespace breach::fem {

using mechanics::Matrix2;

/// Integration data of an element.
struct SspGeometry {
    Gradient dN;            ///< at the centre [1/m]
    Eigen::Vector4d gamma;  ///< hourglass amplitude q = sum_i gamma_i u_i; 0 for linear fields
    Matrix2 H;      ///< hourglass stiffness for c_s = 1: force work-conjugate to q = c_s H q [m]
    double volume;  ///< [m3]
};

/// x: corners [m]. H is the exact integral of the assumed strain e_xx = -e_yy = (xi eta),x q_x / 2
/// - (xi eta),y q_y / 2 with the centre's Jacobian: positive definite for every convex quad.
/// Departs from: OpenSees integrates with normalised base vectors and counts the cross term once,
/// which is indefinite on skewed quads; equal on rectangles.
void evaluate_ssp(const Corners& x, double thickness, SspGeometry& out);

/// Strain operator at the centre (3 x 8) [1/m].
StrainOperator centre_strain_operator(const Gradient& dN);

/// Converts gradients and quadrature to the single point: the first entry is the centre with the
/// whole volume, the others are zero.
void use_centre_only(const SspGeometry& geometry, Gradients& gradients, Quadrature& quadrature);

/// gamma_i gamma_j c_s H: hourglass stiffness [N/m]; c_s = C_11 - C_12 - C_21 + C_22 of the
/// material [Pa], 4 G if isotropic.
Stiffness hourglass_stiffness(const SspGeometry& geometry, double c_s);

/// Nodal forces of the hourglass force Q [N].
Dofs8 hourglass_forces(const SspGeometry& geometry, const Vec2& Q);

/// Hourglass amplitude of nodal values [m].
Vec2 hourglass_amplitude(const SspGeometry& geometry, const Dofs8& u);

}  // namespace breach::fem
