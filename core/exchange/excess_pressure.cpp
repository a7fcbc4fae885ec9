#include "core/exchange/excess_pressure.hpp"

#include "core/mechanics/excess_pressure.hpp"

namespace breach::exchange {

std::vector<double> nodal_excess_pressure(const MeshSnapshot& mesh) {
    if (mesh.pore_pressure_0.empty()) return {};
    return mechanics::nodal_excess_pressure(mesh.position_0, mesh.quads, mesh.pore_pressure,
                                            mesh.pore_pressure_0);
}

std::vector<double> largest_excess_pressure(const MeshSnapshot& mesh) {
    return mesh.excess_pressure_max.empty() ? nodal_excess_pressure(mesh)
                                            : mesh.excess_pressure_max;
}

}  // namespace breach::exchange
