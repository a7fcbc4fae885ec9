// Present undrained strength of soil with a state parameter, over its initial stress.
#pragma once

#include "fem_solver/model/model.hpp"
#include "fem_solver/solve/beginning.hpp"

namespace breach::fem {

/// Undrained peak strength s_u over sigma'_v0, the vertical effective stress when the first dynamic
/// stage began [-].
struct StrengthRatio {
    double average = 0.0;  ///< by volume
    double least = 0.0;
};
/// Over such soil in the body, in a wet scene over its saturated elements; excludes points with initial stresses below
/// the law's least mean stress. With the material's S; without suction: strengths are at most the critical ones at p' +
/// u, as in the transfer. Zeros if no point counts.
StrengthRatio strength_ratio(const Model& model, const Motion& motion, const Beginning& beginning);

}  // namespace breach::fem
