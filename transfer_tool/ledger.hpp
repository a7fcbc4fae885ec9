// The ledger of a transfer: quantities on the mesh and on the points, per region and in total.
//
// 'Before' is computed from the mesh by exact integrals of the finite-element fields over each
// element (closed form, no quadrature):
//
//     mass       rho_0 A_0 t                   volume     A_t t
//     momentum   rho_0 t int N_i J_0 v_i       potential  rho_0 t g int N_i J_0 y_i
//     kinetic    rho_0 t int N_i N_j J_0 v_i.v_j / 2  (consistent mass)
//     elastic    sum over FEM Gauss points of V_g sigma:D^-1:sigma / 2, with D and the total or
//                effective stress of the soil after the transfer
//
// 'After' is a sum over the material points. n >= 2 Gauss points per direction integrate the first
// five exactly: their differences are round-off. With n = 1 momentum and energies are exact on
// parallelograms only. The elastic energy changes by the interpolation and the return to the yield
// surface. Rows "... of the nodes" (total only): 'before' is the FEM's lumped sum, which shows the
// difference of lumped and consistent mass in the kinetic energy. A rebuilt element counts with its
// rebuilt shape on both sides. Row "out-of-balance force" (scenes with /mpm, on the MPM's grid):
// 'before' is what the FEM's accelerations need, 'after' the force of the points' stress and
// gravity; the difference is relative to the weight.
// transfer.cpp makes it from the finished points. run.cpp logs it and writes it to result.json
// before it refuses losses, so that a refused transfer shows where it lost; then the particle file
// gets it.
#pragma once

#include <string>

#include "core/exchange/ledger.hpp"
#include "core/exchange/mesh_snapshot.hpp"
#include "core/scene/scene.hpp"
#include "transfer_tool/soils.hpp"

namespace breach::transfer {

/// Heights are relative to the mesh's lowest node. Differences are relative to `before`, for
/// momentum to the sum of |m v| over the region. The points must have their soils. Throws BadInput
/// if the snapshot's Gauss points are no n x n Gauss-Legendre rule.
exchange::Ledger ledger_of(const exchange::MeshSnapshot& mesh, const Points& points,
                           const SoilMap& map, const scene::Scene& scene, const std::string& file);

/// Table with aligned columns.
std::string as_text(const exchange::Ledger& ledger);

/// Throws Breakdown with each row in which mass, volume, momentum or kinetic energy differ by more
/// than the scene's limits.
void refuse_losses(const exchange::Ledger& ledger, const scene::Transfer& settings);

}  // namespace breach::transfer
