// Elements of a snapshot and what its nodes carry at their corners.
// Read by the transfer for its points, and here for soil that liquefied, so that both see the same
// element.
#pragma once

#include "core/exchange/mesh_snapshot.hpp"
#include "core/geometry/quad.hpp"

namespace breach::liquefied {

using geometry::Corners;
using geometry::shape_functions;
using mechanics::Vec2;

/// A nodal field at an element's corners, in columns.
Corners corner_values(const std::vector<Vec2>& field, const std::array<std::int32_t, 4>& quad);
Eigen::Vector4d corner_values(const std::vector<double>& field,
                              const std::array<std::int32_t, 4>& quad);

/// Index of the Gauss point of an element nearest to xi: what has liquefied has no mean between two.
std::size_t nearest_gauss(const std::vector<Vec2>& gauss_positions, const Vec2& xi);

Corners undeformed_corners(const exchange::MeshSnapshot& mesh, std::size_t element);

/// Horizontal displacement of the mesh's lowest node, the leftmost of several [m].
double displacement_of_base(const exchange::MeshSnapshot& mesh);

/// (u - u_0) / sigma'_v0 [-]; 0 if sigma_v0 is not positive.
double pore_pressure_ratio(double d_u, double sigma_v0);

}  // namespace breach::liquefied
