// The scene's water on this mesh: wet elements, nodes with a prescribed pressure, and the
// permeability of a stage.
#pragma once

#include "fem_solver/model/model.hpp"

namespace breach::fem {

/// [elements] wet by this water, including absent ones.
std::vector<bool> elements_below(const scene::GroundWater& water, const Mesh& mesh);

/// Water below its phreatic line, which is the scene's or a stage's, in the soil present. Throws
/// BadInput when a wet material lacks void_ratio or permeability, when a boundary holds no node, or
/// when the pressure is not determined.
PoreWater ground_water(const scene::Scene& scene, const scene::GroundWater& water,
                       const Model& model);

/// Sets the stage's permeability: free drainage, or the materials' own.
void set_permeability(const scene::Scene& scene, scene::StagePermeability permeability,
                      Model& model);

/// Prevents all flow, for an undrained stage.
void close_to_flow(Model& model);

}  // namespace breach::fem
