// Present undrained strength of soil with a state parameter, over its initial stress.
// Recorder computes it at an interval of the scene and not at each row: every point needs an
// undrained path of its own.
#pragma once

#include "fem_solver/model/model.hpp"
#include "fem_solver/solve/beginning.hpp"

namespace breach::fem {

/// Undrained peak strength s_u over sigma'_v0 at the beginning of the first dynamic stage [-].
struct StrengthRatio {
    double average = 0.0;  ///< weighted by volume
    double least = 0.0;
};
/// For soil with a state parameter in the body, in a wet scene its saturated elements; excludes
/// points with initial stress below the law's minimum. With the material's S and without suction:
/// at most the critical strength at p' + u, as in the transfer. Zeros if no point counts.
StrengthRatio strength_ratio(const Model& model, const Motion& motion, const Beginning& beginning);

}  // namespace breach::fem
