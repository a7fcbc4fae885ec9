// The 4-node plane-strain quad: gradients at 2x2 Gauss points and the mean-dilatation strain
// operator B-bar.
// Evaluated once, in build_model: strains are small, and the mesh keeps its drawn shape.
#pragma once

#include <array>

#include "fem_solver/mesh/mesh.hpp"

namespace breach::fem {

using geometry::shape_functions;

inline constexpr int gauss_points = 4;

using StrainOperator =
    Eigen::Matrix<double, 3, 8>;  ///< rows xx, yy, xy (engineering shear); dofs (x, y) per node
using Gradient = Eigen::Matrix<double, 2, 4>;  ///< dN_i/dx, one column per node [1/m]
using Dofs8 = Eigen::Matrix<double, 8, 1>;
using Stiffness = Eigen::Matrix<double, 8, 8>;

/// Natural coordinates (xi, eta) of the Gauss points, in the order of the corners.
const std::array<Vec2, gauss_points>& gauss_positions();

/// Integration data of an element at its Gauss points.
struct Quadrature {
    std::array<StrainOperator, gauss_points> B;  ///< B-bar [1/m]
    std::array<double, gauss_points> weight;     ///< w det J t [m3]
};

/// Standard gradients of the shape functions and weights w det J t.
struct Gradients {
    std::array<Gradient, gauss_points> dN;
    std::array<double, gauss_points> weight;
};

/// x: corners [m]; thickness [m]. The caller must check det J > 0 (positive weights).
void evaluate_gradients(const Corners& x, double thickness, Gradients& out);

/// B-bar of the mean-dilatation method (Hughes 1980): the in-plane volumetric part of B is replaced
/// by its element mean, which leaves one volumetric constraint per element. epsilon_zz = 0 at every
/// point. Departs from: Hughes splits the 3D dilatation (thirds), which gives epsilon_zz != 0 at
/// the points.
void evaluate_quadrature(const Gradients& gradients, Quadrature& out);

/// Integral of N_i dV [m3]: nodal shares of the volume, and lumped mass for unit density.
Eigen::Vector4d nodal_volumes(const Corners& x, double thickness);

}  // namespace breach::fem
