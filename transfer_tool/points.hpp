// Where the material points lie and what they weigh, and the nodal fields they take from the mesh.
#pragma once

#include <vector>

#include "core/exchange/mesh_snapshot.hpp"
#include "core/exchange/particle_state.hpp"
#include "transfer_tool/quad.hpp"

namespace breach::transfer {

/// Places of an element's corners [m].
Corners undeformed_corners(const exchange::MeshSnapshot& mesh, std::size_t element);
Corners deformed_corners(const exchange::MeshSnapshot& mesh, std::size_t element);

/// The new material points, element after element, and where in its element each one lies.
struct Points {
    exchange::ParticleState state;
    std::vector<std::size_t> first;  ///< [n_elements + 1] first point of each element
    std::vector<Vec2> xi;            ///< [n_points] natural coordinates
};

/// Throws Breakdown, naming the elements, the time and |J_t|/|J_0|, when a deformed element is
/// inverted or entangled (J <= 0 at a corner); BadInput when an undeformed one is.
void refuse_entangled(const exchange::MeshSnapshot& mesh, const std::string& file);

/// n x n points at the Gauss positions of each deformed element. With weights w and the thickness
/// t: mass = rho_0 J_0 w t and volume = J_t w t. Both sums are exact for every n, since J is
/// linear.
Points place_points(const exchange::MeshSnapshot& mesh, int n);

/// Velocity v = sum N_i v_i and its gradient L = sum v_i (dN_i/dx)^T on the deformed element.
void carry_nodal_fields(const exchange::MeshSnapshot& mesh, Points& points);

}  // namespace breach::transfer
