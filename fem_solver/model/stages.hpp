// Stages that change the body: elements present, supports, loads on the ground, water
// levels.
#pragma once

#include "fem_solver/model/choose.hpp"
#include "fem_solver/model/model.hpp"

namespace breach::fem {

/// Applies what the stages up to this one have placed, removed, released and loaded. Depends on the
/// scene alone, so that a resumed run has the same. Where stages move the water, or soil below it
/// is missing, the water is rebuilt, without permeability and with the modulus of elastic stages.
/// Throws BadInput where a stage is impossible: it removes all that a support holds, leaves a
/// direction unheld, or changes soil below water without drainage.
void set_stage(const scene::Scene& scene, const ModelDecisions& decided, std::size_t stage,
               Model& model);

/// Sets the creep strain of a load step of this share of the stage, along the in-plane deviators of
/// `motion`; points without a deviator do not creep.
void set_creep_step(double share, const Motion& motion, Model& model);

/// Sets S of the laws with a state parameter. It is 0 where water drains, unless the stage requests S in
/// this region, or drains everywhere and requests S.
void set_softening(const scene::Stage& stage, const Model& model,
                   std::vector<materials::Law>& laws);

/// [nodes] without a present element.
std::vector<bool> lonely_nodes(const Model& model);

/// Sets stress and strain of absent points, and the motion of their nodes, to zero.
void forget_absent(const Model& model, Motion& motion);

}  // namespace breach::fem
