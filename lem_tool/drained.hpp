// Flags soil that can lose its strength undrained but is analysed with its drained strength: such a
// dam can fail in spite of this factor of safety.
#pragma once

#include <vector>

#include "core/fault/flag.hpp"
#include "core/scene/scene.hpp"

namespace breach::lem {

/// One flag for each region with a state parameter that has friction (neither /lem/undrained nor a strength with
/// phi = 0) where it is wet, looser than critical and in no layer of /lem/liquefaction. Wet as in the analysis:
/// by /lem/water, a piezometric line or r_u.
std::vector<fault::Flag> flags_of_drained(const scene::Scene& scene);

}  // namespace breach::lem
