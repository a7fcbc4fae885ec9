// Unbalanced force of the new points on the MPM's grid, with the MPM's kernel: the force in its
// first step.
// Reported in the ledger, never refused: after liquefaction and a return to the yield surface the
// soil need not be in balance.
#pragma once

#include <vector>

#include "core/scene/scene.hpp"
#include "transfer_tool/points.hpp"

namespace breach::transfer {

/// Of one soil: sums over the grid's nodes, each shared among soils by mass. Nodes at walls and
/// floor count in their free directions only.
struct GridForce {
    double inertia = 0.0;  ///< sum |m_i a_i| with the FEM's acceleration [N]
    double force = 0.0;    ///< sum |f_i,internal + m_i g| [N]
    double weight = 0.0;   ///< sum m_i g [N]

    GridForce& operator+=(const GridForce& other) {
        inertia += other.inertia;
        force += other.force;
        weight += other.weight;
        return *this;
    }
};

/// Internal force of the stress, per soil: f_i = - sum_p V_p (sigma_p - u_p I) grad N_ip with u = 0
/// beside total and buoyant stress, and of `still_gradient`, the standing water's at each point
/// [Pa/m]: - sum_p V_p N_ip grad p; empty: no water.
std::vector<GridForce> grid_force(const scene::Scene& scene, const Points& points,
                                  const std::vector<Vec2>& still_gradient = {});

}  // namespace breach::transfer
