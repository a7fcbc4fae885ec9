// Gravity for a law with memory (PM4Sand): elastic gravity leaves stresses outside its surfaces at faces and ponds,
// from which the law cannot return. A friction-only analysis finds a stress field inside, in equilibrium; the law
// begins from that.
#pragma once

#include <string>

#include "fem_solver/solve/step.hpp"

namespace breach::fem {

/// Whether a stage that begins such a law searches for that field first: a static one after
/// another.
bool rests_first(const scene::Stage& stage, std::int64_t place);

/// Limit of iterations for one level of the search: unlike a dynamic step it cannot be cut, and
/// giving it up leaves soil outside its surfaces (Mochikoshi on 0.6 m: 545 for all levels).
inline constexpr int iterations_to_rest = 400;
/// Limit of iterations without a better residual: then no equilibrium exists at this level.
inline constexpr int patience_to_rest = 60;

/// Result of the search.
struct FrictionalRest {
    bool converged = false;
    double cohesion = 0.0;  ///< least one in equilibrium; the first one tried when none
                            ///< was [Pa]
    double residual = 0.0;  ///< out of balance there, over the weight [-]
    int iterations = 0;
};
/// One sentence: the result, or that there was no equilibrium and what to do.
std::string in_words(const FrictionalRest& rest);

/// Takes `motion` from elastic equilibrium to one in which every zone with memory is Mohr-Coulomb with
/// the least friction of its points' surfaces (PM4Sand: sin(phi) = M_b / 2), and a cohesion that is
/// halved level by level, by less where that does not converge. If not even the first level converges,
/// `motion` is unchanged. Flow is associated: the tangent stays symmetric, and the strains are
/// discarded.
FrictionalRest rest_with_friction(Newton& newton, const Model& model, Motion& motion,
                                  Prediction& prediction, Motion& trial);

}  // namespace breach::fem
