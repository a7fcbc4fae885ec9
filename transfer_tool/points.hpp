// Positions and masses of the material points, and their fields from the mesh's nodes.
// Made by place_points, then completed step by step in transfer.cpp; each step names the fields
// that it sets.
#pragma once

#include <vector>

#include "core/exchange/mesh_snapshot.hpp"
#include "core/exchange/particle_state.hpp"
#include "transfer_tool/sampling.hpp"
#include "transfer_tool/shapes.hpp"

namespace breach::transfer {

/// The new material points, element by element, with their natural coordinates.
struct Points {
    exchange::ParticleState state;                   ///< settle_stress sets its stress
    std::vector<mechanics::Voigt> effective_stress;  ///< [n_points] interpolated [Pa]
    std::vector<Corners> shape;                      ///< [n_elements] corners for the points [m]
    std::vector<std::size_t> first;  ///< [n_elements + 1] first point of each element
    std::vector<Vec2> xi;            ///< [n_points] natural coordinates
    std::vector<Vec2> acceleration;  ///< [n_points] for the ledger only [m/s2]
};

/// Points at the positions of the sampling's rule in each deformed element. With weights w and
/// thickness t: mass = rho_0 J_0 w t and volume = J_t w t. Both sums are exact for any numbers, as J
/// is linear; with a shift for two or more.
Points place_points(const exchange::MeshSnapshot& mesh, std::vector<Corners> shapes,
                    const Sampling& sampling, const Shift& shift = {});

/// By shape functions: velocity v = sum N_i v_i, its gradient L = sum v_i (dN_i/dx)^T on the
/// deformed element, acceleration; if the snapshot has them, pore pressure u = sum N_i u_i and r_u
/// = sum N_i (u - u_0)_i / sum N_i sigma'_v0,i (0 without stress), u and u_0 without their
/// alternating parts.
void carry_nodal_fields(const exchange::MeshSnapshot& mesh, Points& points);

}  // namespace breach::transfer
