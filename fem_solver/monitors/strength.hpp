// Present undrained strength of soil with a state parameter, over the stress that it began under.
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
/// Of such soil in the body, in a wet scene of its saturated elements; points that began under less
/// than the law's least mean stress do not count. With the material's S; no suction is counted on: strengths are at most
/// the critical ones at p' + u, as the transfer's. Zeros where no point counts.
StrengthRatio strength_ratio(const Model& model, const Motion& motion, const Beginning& beginning);

}  // namespace breach::fem
