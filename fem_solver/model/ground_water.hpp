// Pore water of a scene on the mesh: wet elements, prescribed pressures, and a stage's
// permeability.
// build_model makes the water of the first stage; set_stage makes it anew where stages move it.
#pragma once

#include "fem_solver/model/model.hpp"

namespace breach::fem {

/// [elements] wet with this water, including absent ones.
std::vector<bool> elements_below(const scene::GroundWater& water, const Mesh& mesh);

/// Water below its phreatic line (the scene's or a stage's) in the present soil. Throws BadInput if
/// a wet material lacks void_ratio or permeability, a boundary contains no node, or the pressure is
/// indeterminate.
PoreWater ground_water(const scene::Scene& scene, const scene::GroundWater& water,
                       const Model& model);

/// Sets the stage's permeability: free drainage, or that of the materials.
void set_permeability(const scene::Scene& scene, scene::StagePermeability permeability,
                      Model& model);

/// Text "; or ..." for a stage without equilibrium, if its water rests below a line that slopes;
/// empty otherwise.
std::string seepage_remedy(const scene::Scene& scene, std::size_t stage);

/// Prevents all flow, for an undrained stage.
void close_to_flow(Model& model);

}  // namespace breach::fem
