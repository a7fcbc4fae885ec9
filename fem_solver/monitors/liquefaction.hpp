// Liquefied nodes by the excess pore pressure ratio, and the depth of liquefaction.
// Used by Watch for telemetry, by upstream_wall at the end. Excess pressures come smoothed
// (core/mechanics/excess_pressure): those of single nodes alternate.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "fem_solver/mesh/mesh.hpp"

namespace breach::fem {

/// Excess pore pressure ratio r_u = (u - u_0) / sigma'_v0 [-] at the nodes (Sordo et al. 2024, Eq.
/// 1). excess = u - u_0, sigma_v0: [nodes] Pa. 0 if sigma'_v0 is below `least_stress` [Pa], near
/// the ground.
std::vector<double> pore_pressure_ratio(std::span<const double> excess,
                                        std::span<const double> sigma_v0, double least_stress);

/// The watched nodes, and the level of depth 0.
struct LiquefactionWindow {
    std::vector<std::size_t> regions;  ///< with liquefiable soil
    std::array<double, 2> x;           ///< range of the nodes [m]
    double level;                      ///< y of zero depth [m]
    double threshold;                  ///< liquefied if r_u is above [-]
};

/// Nodes of the window, in ascending order.
std::vector<std::int32_t> nodes_in(const Mesh& mesh, const LiquefactionWindow& window);

/// Depth of the deepest liquefied node below the window's level [m]; 0 if none.
double liquefaction_depth(const Mesh& mesh, std::span<const std::int32_t> nodes,
                          std::span<const double> r_u, const LiquefactionWindow& window);

}  // namespace breach::fem
