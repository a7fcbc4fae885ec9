// The reference scheme: explicit sub-steps as in OpenSees (scheme 5), for comparison with it.
#pragma once

#include "core/materials/pm4sand/call.hpp"

namespace breach::materials::pm4sand {

/// integrate() with the reference scheme; d must be finite.
Update integrate_reference(const Ready& law, const State& old, const Strain<double>& d,
                           const Options& options);

}  // namespace breach::materials::pm4sand
