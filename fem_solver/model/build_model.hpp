// Builds the model of a scene on a mesh: constraints, masses and laws.
#pragma once

#include "fem_solver/model/choose.hpp"

namespace breach::fem {

/// Throws BadInput when supports, water, base or columns do not fit the mesh.
Model build_model(const scene::Scene& scene, Mesh mesh);
/// The same with the decisions about the scene.
Model build_model(const scene::Scene& scene, const ModelDecisions& decided, Mesh mesh);

/// Sets the masses, and as the external force the weight and this share of it towards +x, of the
/// elements present.
void set_weights(double gravity, double seismic_coefficient, Model& model);

}  // namespace breach::fem
