// The ground surface of the mesh and the loads on it: ponded water and surcharge.
// Called by build_model and for each stage that changes the body: soil that is removed or placed
// has another ground.
#pragma once

#include "core/geometry/polyline.hpp"
#include "fem_solver/model/choose.hpp"

namespace breach::fem {

using geometry::level_at;

/// An outer edge of the mesh that faces upwards, or sideways within the section.
struct GroundEdge {
    std::int32_t a;
    std::int32_t b;
    Vec2 outwards;  ///< normal times area [m2]
};
std::vector<GroundEdge> ground_edges(const Model& model);

/// Adds a pressure on outer edges to the external force; returns their number.
std::size_t add_edge_pressure(const scene::EdgePressure& load, Model& model);

/// Adds to the external force: ponded water (normal to the ground, linear along an edge) and
/// surcharge (vertical, per horizontal length). They do not follow the ground's motion.
void add_ground_loads(const ModelDecisions& decided, Model& model);

}  // namespace breach::fem
