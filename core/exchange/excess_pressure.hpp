// Excess pore pressure of a snapshot, for r_u, liquefied zones and figures.
#pragma once

#include "core/exchange/mesh_snapshot.hpp"

namespace breach::exchange {

/// u - u_0 [Pa] at the nodes, smoothed over elements (core/mechanics/excess_pressure.hpp); empty if
/// the snapshot has no u_0.
std::vector<double> nodal_excess_pressure(const MeshSnapshot& mesh);

/// Its maximum since the shaking began; the present value if the snapshot stores no maximum. With
/// it, soil that has drained since still counts as liquefied (LiquefiedWhen::ever).
std::vector<double> largest_excess_pressure(const MeshSnapshot& mesh);

}  // namespace breach::exchange
