// Stages that change the body: which elements are there, which supports hold, what lies on the
// ground, where the water stands.
#pragma once

#include "fem_solver/model/choose.hpp"
#include "fem_solver/model/model.hpp"

namespace breach::fem {

/// Puts in force what the stages up to this one have placed, removed, released and loaded. Asks the
/// scene alone, so that a resumed run has the same. Where stages move the water, or it stands where
/// soil is missing, it is made anew, without permeability and with the modulus of elastic stages.
/// Throws BadInput where a stage cannot be: it removes all that a support holds, leaves a direction
/// unheld, or changes what is below water without drainage.
void set_stage(const scene::Scene& scene, const ModelDecisions& decided, std::size_t stage,
               Model& model);

/// The creep strain of a load step of this share of the stage, along the deviators in the plane that
/// `motion` has; points without a deviator do not creep.
void set_creep_step(double share, const Motion& motion, Model& model);

/// Sets S of the laws with a state parameter. It is 0 where water drains, unless the stage asks for S in
/// this region, or drains everywhere and asks for S.
void set_softening(const scene::Stage& stage, const Model& model,
                   std::vector<materials::Law>& laws);

/// [nodes] of no element that is there.
std::vector<bool> lonely_nodes(const Model& model);

/// Takes stress and strain from the points that are not there, and the motion from their nodes.
void forget_absent(const Model& model, Motion& motion);

}  // namespace breach::fem
