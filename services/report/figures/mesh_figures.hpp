// Pictures of a FEM snapshot: values on the deformed mesh, its borders and its edges.
#pragma once

#include <span>

#include "core/exchange/mesh_snapshot.hpp"
#include "services/report/chart/chart.hpp"

namespace breach::report {

/// Element averages of epsilon_q = sqrt(2/3 e:e) over the Gauss points [%].
std::vector<double> element_epsilon_q(const exchange::MeshSnapshot& mesh);
/// r_u = (u - u_0) / sigma'_v0, averaged over an element's nodes [-]; empty for a dry mesh. Nodes
/// without vertical stress count as 0.
std::vector<double> element_r_u(const exchange::MeshSnapshot& mesh);
/// The same for a given u - u_0. excess: [nodes] Pa
std::vector<double> element_r_u(const exchange::MeshSnapshot& mesh, std::span<const double> excess);

/// The elements in their deformed places, coloured by `value`.
Field on_deformed_mesh(const exchange::MeshSnapshot& mesh, std::vector<double> value,
                       const std::string& label, const Range& range);
/// Edges of the deformed mesh as segments: all, or only those between regions and on the outside.
Series edges_of(const exchange::MeshSnapshot& mesh);
Series borders_of(const exchange::MeshSnapshot& mesh);

/// From 0 to a round number above 99 % of the values.
Range colour_range(std::vector<double> values);

}  // namespace breach::report
