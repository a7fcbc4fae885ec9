// The list of the laws of material points, for the MPM's loops (lane_law.hpp). The loops depend on
// this list, never on a particular law.
#pragma once

#include "core/materials/drucker_prager/lanes.hpp"
#include "core/materials/lane_law.hpp"
#include "core/materials/mohr_coulomb/lanes.hpp"

namespace breach::materials {

template <class... Each>
struct LawList {};

using LaneLaws = LawList<LinearElasticLanes, MohrCoulombLanes<Softens::never>,
                         MohrCoulombLanes<Softens::with_plastic_strain>,
                         MohrCoulombLanes<Softens::with_total_strain>,
                         MohrCoulombOfPointsLanes<Softens::with_plastic_strain>,
                         MohrCoulombOfPointsLanes<Softens::with_total_strain>, DruckerPragerLanes>;

}  // namespace breach::materials
