// The corners of the elements for a transfer: those of the deformed mesh, or, for an inverted
// element if the scene asks for it, its undistorted shape.
#pragma once

#include <string>
#include <vector>

#include "core/exchange/mesh_snapshot.hpp"
#include "core/geometry/quad.hpp"
#include "core/scene/scene.hpp"

namespace breach::transfer {

using geometry::corner_jacobians;
using geometry::Corners;
using geometry::integral;
using geometry::jacobian;
using geometry::shape_functions;
using geometry::shape_gradients;
using mechanics::Matrix2;
using mechanics::Vec2;

/// Any nodal field at an element's corners, columns are corners.
Corners corner_values(const std::vector<Vec2>& field, const std::array<std::int32_t, 4>& quad);
Eigen::Vector4d corner_values(const std::vector<double>& field,
                              const std::array<std::int32_t, 4>& quad);

/// Places of an element's corners [m].
Corners undeformed_corners(const exchange::MeshSnapshot& mesh, std::size_t element);
Corners deformed_corners(const exchange::MeshSnapshot& mesh, std::size_t element);

/// Nodal pressure [Pa] at the corners of an element of shape x, without the part that alternates
/// between them: the pressure in the FEM's forces. Its mean stays, and so does a pressure that is
/// linear in x.
Eigen::Vector4d corner_pressure(const std::vector<double>& pressure,
                                const std::array<std::int32_t, 4>& quad, const Corners& x);

/// An element that was inverted or entangled (J <= 0 at a corner).
struct RebuiltElement {
    std::size_t element;
    std::string region;
    Vec2 centre;          ///< [m]
    double least;         ///< worst corner's |J_t|/|J_0| on the mesh [-]
    double area_on_mesh;  ///< signed [m2]
    double area;          ///< of its new shape: the undeformed one [m2]
};

struct Shapes {
    std::vector<Corners> corners;  ///< [n_elements], every one with J > 0 at its corners [m]
    std::vector<RebuiltElement> rebuilt;
};

/// refuse: throws Breakdown, naming the elements, the time and |J_t|/|J_0|, when a deformed element
/// is inverted or entangled. rebuild: such an element takes its undeformed shape, centred at the
/// mean of its displaced corners, rotated with its edges as far as they still agree. BadInput when
/// an undeformed element is inverted.
Shapes shapes_of_elements(const exchange::MeshSnapshot& mesh, scene::Entangled policy,
                          const std::string& file);

}  // namespace breach::transfer
