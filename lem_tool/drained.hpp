// Soil that can lose its strength undrained, judged by its drained strength alone: a factor of safety
// that such a dam fails with.
#pragma once

#include <vector>

#include "core/fault/flag.hpp"
#include "core/scene/scene.hpp"

namespace breach::lem {

/// One flag for each region with a state parameter that has friction (neither /lem/undrained nor a strength with
/// phi = 0) where it is wet, looser than critical and in no layer of /lem/liquefaction. Wet is what
/// the analysis takes it for: by /lem/water, a piezometric line or r_u.
std::vector<fault::Flag> flags_of_drained(const scene::Scene& scene);

}  // namespace breach::lem
