// What the scene says of water, on this mesh: which elements are wet, where the pressure is
// prescribed, and how freely the water flows in a stage.
#pragma once

#include "fem_solver/model/model.hpp"

namespace breach::fem {

/// [elements] wet by this water, whether they are there or not.
std::vector<bool> elements_below(const scene::GroundWater& water, const Mesh& mesh);

/// Water below its phreatic line, which is the scene's or a stage's, in the soil that is there. Throws
/// BadInput when a wet material lacks void_ratio or permeability, when a boundary holds no node, or
/// when the pressure is not determined.
PoreWater ground_water(const scene::Scene& scene, const scene::GroundWater& water,
                       const Model& model);

/// Puts the stage's permeability in force: free drainage, or the materials' own.
void set_permeability(const scene::Scene& scene, scene::StagePermeability permeability,
                      Model& model);

/// No water flows: what an undrained stage has.
void close_to_flow(Model& model);

}  // namespace breach::fem
