// The out-of-balance force of the new points on the MPM's grid, evaluated once with the MPM's
// kernel: the force in its first step, before any motion.
#pragma once

#include <vector>

#include "core/scene/scene.hpp"
#include "transfer_tool/points.hpp"

namespace breach::transfer {

/// By soil: sums over the grid's nodes, every node shared among the soils by mass. Nodes that a
/// wall or the floor holds count only in the direction in which they are free.
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

/// Internal force of the total stress: f_i = - sum_p V_p (sigma_p - u_p I) grad N_ip.
std::vector<GridForce> grid_force(const scene::Scene& scene, const Points& points);

}  // namespace breach::transfer
