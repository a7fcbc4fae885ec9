// Gravity that a law with memory (PM4Sand) can carry: elastic gravity leaves stresses outside its surfaces at faces and
// ponds, and there is no way back for the law itself. Friction alone finds a stress field inside,
// in equilibrium; from that the law begins.
#pragma once

#include <string>

#include "fem_solver/solve/step.hpp"

namespace breach::fem {

/// Whether a stage that begins such a law looks for that field first: a static one after
/// another.
bool rests_first(const scene::Stage& stage, std::int64_t place);

/// Iterations that a level of the search may take: unlike a dynamic step it cannot be cut, and one
/// that is given up leaves soil outside its surfaces (Mochikoshi on 0.6 m: 545 for all levels).
inline constexpr int iterations_to_rest = 400;
/// And how many of them without coming nearer: a level that nothing can hold is known by that.
inline constexpr int patience_to_rest = 60;

/// What the search came to.
struct FrictionalRest {
    bool converged = false;
    double cohesion = 0.0;  ///< least one that stood in equilibrium; the first one tried when none
                            ///< did [Pa]
    double residual = 0.0;  ///< out of balance there, over the weight [-]
    int iterations = 0;
};
/// One sentence for people: how far it came, or that nothing stood and what to do.
std::string in_words(const FrictionalRest& rest);

/// Takes `motion` from elastic equilibrium to one in which every zone with memory is Mohr-Coulomb with
/// the least friction of its points' surfaces (PM4Sand: sin(phi) = M_b / 2), and a cohesion that
/// is halved level by level, by less where that does not converge. Where not even the first one
/// does, `motion` is as it was. Flow is associated: the tangent stays symmetric, and the strains
/// are of no account here.
FrictionalRest rest_with_friction(Newton& newton, const Model& model, Motion& motion,
                                  Prediction& prediction, Motion& trial);

}  // namespace breach::fem
