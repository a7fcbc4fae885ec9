// The corners of the elements for a transfer: of the deformed mesh, or, for an inverted element if
// the scene requests it, of its undistorted shape.
// The first step of a transfer. All later ones need J > 0: mass and volume are Gauss weights times
// J.
#pragma once

#include <string>
#include <vector>

#include "core/exchange/mesh_snapshot.hpp"
#include "core/liquefied/elements.hpp"
#include "core/scene/scene.hpp"

namespace breach::transfer {

using geometry::corner_jacobians;
using geometry::Corners;
using geometry::integral;
using geometry::jacobian;
using geometry::shape_functions;
using geometry::shape_gradients;
using liquefied::corner_values;
using liquefied::undeformed_corners;
using mechanics::Matrix2;
using mechanics::Vec2;

Corners deformed_corners(const exchange::MeshSnapshot& mesh, std::size_t element);

/// Nodal pressure [Pa] at the corners of an element of shape x, as it acts in the FEM's forces:
/// without the part that alternates between corners. The mean and a pressure linear in x are
/// unchanged.
Eigen::Vector4d corner_pressure(const std::vector<double>& pressure,
                                const std::array<std::int32_t, 4>& quad, const Corners& x);

/// An element that is inverted or entangled (J <= 0 at a corner).
struct RebuiltElement {
    std::size_t element;
    std::string region;
    Vec2 centre;          ///< [m]
    double least;         ///< |J_t|/|J_0| of the worst corner on the mesh [-]
    double area_on_mesh;  ///< signed [m2]
    double area;          ///< of the undeformed shape [m2]
};

struct Shapes {
    std::vector<Corners> corners;  ///< [n_elements], with J > 0 at all corners [m]
    std::vector<RebuiltElement> rebuilt;
};

/// refuse: throws Breakdown with the elements, the time and |J_t|/|J_0| if a deformed element is
/// inverted or entangled. rebuild: such an element gets its undeformed shape, centred at the mean
/// of its displaced corners and rotated to fit them. Throws BadInput if an undeformed element is
/// inverted.
Shapes shapes_of_elements(const exchange::MeshSnapshot& mesh, scene::Entangled policy,
                          const std::string& file);

}  // namespace breach::transfer
