// Stages that change elements, supports, ground loads or water levels.
// Course::place_stage applies them at the beginning of a stage and after a restart, only in scenes
// whose stages change the body.
#pragma once

#include "fem_solver/model/choose.hpp"
#include "fem_solver/model/model.hpp"

namespace breach::fem {

/// Applies all changes up to this stage. Depends on the scene alone, so that a resumed run gets the
/// same. If stages move the water, or soil below it is absent, rebuilds the water without
/// permeability and with the elastic modulus. Throws BadInput for an impossible stage: a support
/// loses all its nodes, a direction has no support, or soil below water without drainage changes.
void set_stage(const scene::Scene& scene, const ModelDecisions& decided, std::size_t stage,
               Model& model);

/// Sets S of the laws with a state parameter. 0 where water drains, unless the stage requests S in
/// this region, or drains everywhere and requests S.
void set_softening(const scene::Stage& stage, const Model& model,
                   std::vector<materials::Law>& laws);

/// [nodes] without a present element.
std::vector<bool> lonely_nodes(const Model& model);

/// Sets stress and strain of absent points, and the motion of their nodes, to zero.
void forget_absent(const Model& model, Motion& motion);

}  // namespace breach::fem
