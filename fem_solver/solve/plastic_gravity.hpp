// Gravity for a law with memory (PM4Sand). Elastic gravity leaves stresses outside its surfaces at
// faces and ponds, from which the law cannot return. A frictional analysis finds an equilibrium
// inside the surfaces as initial state of the law.
// begin_laws (begin_stage.cpp) calls it once per run. With 25 iterations per level, as in steps,
// the search stopped between 0.5 and 13.5 kPa by the mesh.
#pragma once

#include <string>

#include "fem_solver/solve/step.hpp"

namespace breach::fem {

/// Whether a stage that starts such a law searches for that state: a static one after another.
bool rests_first(const scene::Stage& stage, std::int64_t place);

/// Largest number of iterations per level of the search. Large, because a level cannot be divided
/// like a dynamic step, and giving up leaves soil outside its surfaces (Mochikoshi with 0.6 m: 545
/// for all levels).
inline constexpr int iterations_to_rest = 400;
/// Largest number of iterations without a smaller residual; after it the level has no equilibrium.
inline constexpr int patience_to_rest = 60;

struct FrictionalRest {
    bool converged = false;
    double cohesion = 0.0;  ///< lowest in equilibrium; the first trial value if none was [Pa]
    double residual = 0.0;  ///< unbalanced force over the weight at that cohesion [-]
    int iterations = 0;
};
/// The result in words, with a remedy if there is no equilibrium.
std::string in_words(const FrictionalRest& rest);

/// Replaces the laws with memory by Mohr-Coulomb with each zone's smallest friction angle of its
/// points' surfaces (PM4Sand: sin(phi) = M_b / 2) and a cohesion that is halved step by step, by
/// less if that does not converge. Moves `motion` from elastic equilibrium to the last one found;
/// if none is found, `motion` stays unchanged. Flow is associated: the tangent is symmetric, and
/// the strains are discarded.
FrictionalRest rest_with_friction(Newton& newton, const Model& model, Motion& motion,
                                  Prediction& prediction, Motion& trial);

}  // namespace breach::fem
