// Plane-strain tensors in Voigt order (xx, yy, zz, xy) and their invariants. No material behaviour
// here.
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

/// Deviatoric strain with engineering shear kept in the fourth entry.
Voigt deviatoric_strain(const Voigt& epsilon);

/// Equivalent deviatoric strain epsilon_q = sqrt(2/3 e:e) [-]; simple shear gives gamma / sqrt(3).
double epsilon_q(const Voigt& epsilon);

/// Work product sigma : epsilon, engineering shear strain [Pa].
double double_dot(const Voigt& sigma, const Voigt& epsilon);

/// Stress after a rotation of the material by `angle` [rad], counter-clockwise: R sigma R^T, exact.
Voigt rotated_stress(const Voigt& sigma, double angle);

/// Strain [engineering shear] after a rotation of the material by `angle` [rad].
Voigt rotated_strain(Voigt epsilon, double angle);

/// Rotation angle [rad] of the polar decomposition F = R U of a plane deformation gradient, det F >
/// 0.
double rotation_angle(const Matrix2& F);

/// Principal stresses in the plane and out of it, with the direction of the larger in-plane one.
struct Principal {
    double major;   ///< larger in-plane principal stress [Pa]
    double minor;   ///< smaller in-plane principal stress [Pa]
    double normal;  ///< out-of-plane stress zz [Pa]
    double cos_2a;  ///< cosine of twice the angle from x to the major direction
    double sin_2a;  ///< sine of the same
};

Principal principal(const Voigt& sigma);
Voigt from_principal(const Principal& principal);

/// Smallest twice-area Jacobian over the four corners of a quad and at its centre, relative to a
/// reference quad.
struct JacobianRatio {
    double centre;  ///< |J_t| / |J_0| at the centre: area change only, blind to shear
    double least;   ///< least corner ratio: sees shear distortion; <= 0 means entangled
};

/// Corner k uses the edges (k, k+1) and (k, k-1). Both quads counter-clockwise, columns are
/// corners.
JacobianRatio jacobian_ratio(const Eigen::Matrix<double, 2, 4>& current,
                             const Eigen::Matrix<double, 2, 4>& reference);

}  // namespace breach::mechanics
