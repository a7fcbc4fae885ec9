// Soil that can lose its strength undrained, judged by its drained strength alone: a factor of safety
// that such a dam fails with.
#pragma once

#include <vector>

#include "core/fault/flag.hpp"
#include "core/scene/scene.hpp"

namespace breach::lem {

/// One flag for each region of NorSand looser than critical, below the phreatic line, that is neither
/// in /lem/undrained nor in /lem/liquefaction.
std::vector<fault::Flag> flags_of_drained(const scene::Scene& scene);

}  // namespace breach::lem
