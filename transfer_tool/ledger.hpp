// The ledger of a transfer: quantities on the mesh and on the points, per region and in total.
//
// 'Before' is computed from the mesh alone with exact integrals of the finite-element fields over
// each element (closed form in the corner values, no quadrature):
//
//     mass       rho_0 A_0 t                   volume     A_t t
//     momentum   rho_0 t int N_i J_0 v_i       potential  rho_0 t g int N_i J_0 y_i
//     kinetic    rho_0 t int N_i N_j J_0 v_i.v_j / 2  (consistent mass)
//     elastic    sum over FEM Gauss points of V_g sigma:D^-1:sigma / 2, with D and the total or
//                effective stress of the soil that the place becomes
//
// 'After' is a plain sum over the material points. Gauss points with n >= 2 per direction integrate
// each of the first five exactly, so their differences are round-off; with n = 1 momentum and
// energies hold on parallelograms only. The elastic energy moves with the interpolation and the
// return to the yield surface. In the rows "... of the nodes" (total only) 'before' is the FEM's
// own lumped sum: their kinetic energy shows what lumping differs from the consistent mass. An
// element that was rebuilt counts with its rebuilt shape on both sides. In the row "out-of-balance
// force" (scenes with /mpm), both on the MPM's grid, 'before' is what the FEM's accelerations need,
// 'after' what stress and gravity of the points give, and the difference is relative to the weight.
#pragma once

#include <string>

#include "core/exchange/ledger.hpp"
#include "core/exchange/mesh_snapshot.hpp"
#include "core/scene/scene.hpp"
#include "transfer_tool/soils.hpp"

namespace breach::transfer {

/// Heights are measured from the mesh's lowest node. Differences are relative to `before`, for
/// momentum to the sum of |m v| over the points of the region. The points have their soils. Throws
/// BadInput if the snapshot's Gauss points are no n x n Gauss-Legendre rule.
exchange::Ledger ledger_of(const exchange::MeshSnapshot& mesh, const Points& points,
                           const SoilMap& map, const scene::Scene& scene, const std::string& file);

/// Aligned columns for people.
std::string as_text(const exchange::Ledger& ledger);

/// Throws Breakdown, naming each row, when mass, volume, momentum or kinetic energy differ by more
/// than the scene's limits.
void refuse_losses(const exchange::Ledger& ledger, const scene::Transfer& settings);

}  // namespace breach::transfer
