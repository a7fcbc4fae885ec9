// Plane-strain tensors in Voigt order (xx, yy, zz, xy) and their invariants; shapes of quads.
#pragma once

#include <Eigen/Core>

namespace breach::mechanics {

using Vec2 = Eigen::Vector2d;
using Matrix2 = Eigen::Matrix2d;
/// Stress [Pa], tension positive, or strain [-] with engineering shear; order (xx, yy, zz, xy).
using Voigt = Eigen::Vector4d;
using Matrix4 = Eigen::Matrix4d;

/// Mean stress sigma_m = tr(sigma) / 3 [Pa], tension positive.
double mean_stress(const Voigt& sigma);

/// Deviatoric stress s = sigma - sigma_m I [Pa].
Voigt deviator(const Voigt& sigma);

/// Equivalent deviatoric strain epsilon_q = sqrt(2/3 e:e) [-]; simple shear gives gamma / sqrt(3).
double epsilon_q(const Voigt& epsilon);

/// Jacobian of a quad relative to its reference shape.
struct JacobianRatio {
    double centre;  ///< at the centre: change of area; does not detect shear
    double least;   ///< smallest at a corner: detects shear; <= 0: entangled
};

/// The Jacobian at corner k is the cross product of the edges (k, k+1) and (k, k-1). Columns are
/// corners, counter-clockwise.
JacobianRatio jacobian_ratio(const Eigen::Matrix<double, 2, 4>& current,
                             const Eigen::Matrix<double, 2, 4>& reference);

}  // namespace breach::mechanics
