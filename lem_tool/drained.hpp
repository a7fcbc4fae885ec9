// Flags soil that can fail undrained but is analysed with drained strength: the dam may fail in
// spite of this factor of safety.
// Called once, by analysis.cpp. Friction alone would call loose tailings safe that flow when they
// are sheared faster than they drain.
#pragma once

#include <vector>

#include "core/fault/flag.hpp"
#include "core/scene/scene.hpp"

namespace breach::lem {

/// One flag per region with a state parameter and friction (neither /lem/undrained nor a strength
/// with phi = 0) that is wet, looser than critical and in no layer of /lem/liquefaction. Wet: by
/// /lem/water, a piezometric line or r_u, as in the analysis.
std::vector<fault::Flag> flags_of_drained(const scene::Scene& scene);

}  // namespace breach::lem
