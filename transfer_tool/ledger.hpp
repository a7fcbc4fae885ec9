// The ledger of a transfer: what was on the mesh, what is on the points, per region and in total.
//
// 'Before' is computed from the mesh alone with exact integrals of the finite-element fields over
// each element (closed form in the corner values, no quadrature):
//     mass       rho_0 A_0 t                        volume     A_t t
//     momentum   rho_0 t int N_i J_0 v_i            kinetic    rho_0 t int N_i N_j J_0 v_i.v_j / 2
//     (consistent mass) potential  rho_0 t g int N_i J_0 y_i          elastic    sum over FEM Gauss
//     points of V_g sigma:D^-1:sigma / 2
// 'After' is a plain sum over the material points. Gauss points with n >= 2 per direction integrate
// each of the first five exactly, so their differences are round-off; with n = 1 momentum and
// energies hold on parallelograms only. The elastic energy moves with the interpolation and the
// return to the yield surface. In the rows "... of the nodes" (total only) 'before' is the FEM's
// own lumped sum: their kinetic energy shows what lumping differs from the consistent mass.
#pragma once

#include <span>
#include <string>

#include "core/exchange/ledger.hpp"
#include "core/exchange/mesh_snapshot.hpp"
#include "core/exchange/particle_state.hpp"
#include "core/scene/scene.hpp"

namespace breach::transfer {

/// gravity [m/s2] downwards; heights are measured from the mesh's lowest node. Differences are
/// relative to `before`, for momentum to the sum of |m v| over the points of the region. Throws
/// BadInput if the snapshot's Gauss points are no n x n Gauss-Legendre rule.
exchange::Ledger ledger_of(const exchange::MeshSnapshot& mesh,
                           const exchange::ParticleState& points,
                           std::span<const materials::Law> laws, double gravity,
                           const std::string& file);

/// Aligned columns for people.
std::string as_text(const exchange::Ledger& ledger);

/// Throws Breakdown, naming each row, when mass, volume or momentum differ by more than the scene
/// allows.
void refuse_losses(const exchange::Ledger& ledger, const scene::Transfer& settings);

}  // namespace breach::transfer
