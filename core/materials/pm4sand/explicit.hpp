// The reference scheme: explicit sub-steps as OpenSees takes them (scheme 5), for parity.
#pragma once

#include "core/materials/pm4sand/call.hpp"

namespace breach::materials::pm4sand {

/// integrate() by the reference scheme; d is finite.
Update integrate_reference(const Ready& law, const State& old, const Strain<double>& d,
                           const Options& options);

}  // namespace breach::materials::pm4sand
