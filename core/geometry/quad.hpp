// The bilinear quad: shape functions, Jacobian, Gauss-Legendre rules and exact integrals of
// products of shape functions. Corners counter-clockwise, natural coordinates (xi, eta) in [-1, 1].
#pragma once

#include <optional>
#include <vector>

#include "core/mechanics/tensor.hpp"

namespace breach::geometry {

using mechanics::Matrix2;
using mechanics::Vec2;
using Corners = Eigen::Matrix<double, 2, 4>;  ///< columns are corners [m]

/// N_i(xi) [-].
Eigen::Vector4d shape_functions(const Vec2& xi);
/// dN_i/d(xi, eta), rows: direction, columns: corner.
Corners shape_gradients(const Vec2& xi);
/// dx/d(xi, eta) [m]; its determinant is the Jacobian J.
Matrix2 jacobian(const Corners& x, const Vec2& xi);
/// J at the four corners [m2]. J is linear in xi and eta, so these are its extremes and J = sum N_k
/// J_k exactly.
Eigen::Vector4d corner_jacobians(const Corners& x);

/// Where in the quad a place lies; none: outside it, by more than round-off.
std::optional<Vec2> natural_coordinates(const Corners& x, const Vec2& place);

/// Integral over [-1, 1]^2 of N_i N_k, and of N_i N_j N_k; exact.
double integral(int i, int k);
double integral(int i, int j, int k);

/// Positions in [-1, 1] and weights (sum 2) of n-point Gauss-Legendre quadrature, n >= 1, exact to
/// degree 2n - 1.
struct GaussRule {
    std::vector<double> position;
    std::vector<double> weight;
};
GaussRule gauss_legendre(int n);
/// Like gauss_legendre, with the points moved towards +1 (shift > 0) or -1: the roots of P_n -
/// shift P_(n-1). |shift| < 1; 0: Gauss-Legendre, +-1: Radau. The weights stay positive; exact to
/// degree 2 n - 2.
GaussRule shifted_rule(int n, double shift);
/// n points, nearly even: shifted_rule of two points in each of n / 2 parts of [-1, 1], the middle
/// one longer and with three where n is odd. Exact to degree 3 (2 with a shift) for every n >= 2.
GaussRule even_rule(int n, double shift);

}  // namespace breach::geometry
