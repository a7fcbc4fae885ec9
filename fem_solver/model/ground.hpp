// The ground surface of the mesh and the loads on it: ponded water and surcharge.
#pragma once

#include "core/geometry/polyline.hpp"
#include "fem_solver/model/choose.hpp"

namespace breach::fem {

using geometry::level_at;

/// An edge of the mesh that looks upwards, or sideways within the section.
struct GroundEdge {
    std::int32_t a;
    std::int32_t b;
    Vec2 outwards;  ///< normal times area [m2]
};
std::vector<GroundEdge> ground_edges(const Model& model);

/// Adds a pressure on outer edges to the external force; returns the number of edges.
std::size_t add_edge_pressure(const scene::EdgePressure& load, Model& model);

/// Pressure of free water with its surface at `line` on a point of the ground, 0 above it [Pa].
double pond_pressure(const scene::GroundWater& water, double gravity, const Vec2& x);

/// Adds the forces of ponded water (normal to the ground, linear along an edge) and of the
/// surcharge (vertical, on the edge's horizontal extent) to the model's external force. They stay
/// as they are when the ground moves.
void add_ground_loads(const ModelDecisions& decided, Model& model);

}  // namespace breach::fem
