// From a snapshot's fields; the smoothing itself is in core/mechanics, where the FEM uses the same
// for its largest value so far. The transfer's liquefied zone and the dashboard's frames ask here.
#include "core/exchange/excess_pressure.hpp"

#include <algorithm>

#include "core/mechanics/excess_pressure.hpp"

namespace breach::exchange {

std::vector<double> nodal_excess_pressure(const MeshSnapshot& mesh) {
    if (mesh.pore_pressure_0.empty()) return {};
    return mechanics::nodal_excess_pressure(mesh.position_0, mesh.quads, mesh.pore_pressure,
                                            mesh.pore_pressure_0);
}

std::vector<double> largest_excess_pressure(const MeshSnapshot& mesh) {
    std::vector<double> largest = nodal_excess_pressure(mesh);
    for (std::size_t i = 0; i < mesh.excess_pressure_max.size(); ++i)
        largest[i] = std::max(largest[i], mesh.excess_pressure_max[i]);
    return largest;
}

}  // namespace breach::exchange
