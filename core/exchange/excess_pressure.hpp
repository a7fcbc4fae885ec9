// The excess pore pressure of a snapshot, for r_u, liquefied zones and figures.
#pragma once

#include "core/exchange/mesh_snapshot.hpp"

namespace breach::exchange {

/// u - u_0 [Pa] at the nodes, as means of element means (core/mechanics/excess_pressure.hpp); empty
/// where the snapshot has no u_0.
std::vector<double> nodal_excess_pressure(const MeshSnapshot& mesh);

/// Its maximum since the shaking began, or at the snapshot's own time if it stores no maximum.
std::vector<double> largest_excess_pressure(const MeshSnapshot& mesh);

}  // namespace breach::exchange
