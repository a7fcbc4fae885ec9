// Gravity that PM4Sand can carry: elastic gravity leaves stresses outside its surfaces at faces and
// ponds, and there is no way back for the law itself. Friction alone finds a stress field inside,
// in equilibrium; from that the law begins.
#pragma once

#include "fem_solver/solve/step.hpp"

namespace breach::fem {

/// Whether a stage that begins PM4Sand's law looks for that field first: a static one after
/// another.
bool rests_first(const scene::Stage& stage, std::int64_t place);

/// What the search came to.
struct FrictionalRest {
    double cohesion = 0.0;  ///< least one that stood in equilibrium [Pa]
    double residual = 0.0;  ///< out of balance there, over the weight [-]
    int iterations = 0;
};

/// Takes `motion` from elastic equilibrium to one in which every PM4Sand zone is Mohr-Coulomb with
/// the friction of its bounding surface, sin(phi) = M_b / 2 at the zone's least M_b, and a cohesion
/// that is halved level by level, by less where that does not converge. Cohesion 0: none did, and
/// `motion` is as it was. Flow is associated: the tangent stays symmetric, and the strains
/// are of no account here.
FrictionalRest rest_with_friction(Newton& newton, const Model& model, Motion& motion,
                                  Prediction& prediction, Motion& trial);

}  // namespace breach::fem
