// Builds the model of a scene on a mesh: constraints, masses and laws.
// Called once per run, before any stage. Stages change the model later (model/stages.hpp).
#pragma once

#include "fem_solver/model/choose.hpp"

namespace breach::fem {

/// Throws BadInput if supports, water, base or columns do not match the mesh.
Model build_model(const scene::Scene& scene, Mesh mesh);
Model build_model(const scene::Scene& scene, const ModelDecisions& decided, Mesh mesh);

/// Sets the masses of the present elements, and as external force their weight and, towards +x,
/// seismic_coefficient times their weight.
void set_weights(double gravity, double seismic_coefficient, Model& model);

}  // namespace breach::fem
