// The model of a scene on a mesh: who stands on what, weighs how much and obeys which law.
#pragma once

#include "fem_solver/model/model.hpp"

namespace breach::fem {

/// Throws BadInput when supports, water, base or columns do not fit the mesh.
Model build_model(const scene::Scene& scene, Mesh mesh);

}  // namespace breach::fem
