// The excess pore pressure of a snapshot as r_u, liquefied zones and figures read it.
#pragma once

#include "core/exchange/mesh_snapshot.hpp"

namespace breach::exchange {

/// u - u_0 [Pa] at the nodes, as means of element means (core/mechanics/excess_pressure.hpp); empty
/// where the snapshot has no u_0.
std::vector<double> nodal_excess_pressure(const MeshSnapshot& mesh);

/// The largest of it since the shaking began, as far as the snapshot knows: its own instant at least.
std::vector<double> largest_excess_pressure(const MeshSnapshot& mesh);

}  // namespace breach::exchange
