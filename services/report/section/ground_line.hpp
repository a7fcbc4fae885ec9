// The surface of a section's soil as a line.
#pragma once

#include <vector>

#include "core/scene/scene.hpp"

namespace breach::report {

/// The ground's line over [from, to], piece by piece where soil lies [m].
std::vector<std::vector<mechanics::Vec2>> ground_between(const scene::Scene& scene, double from,
                                                         double to);

}  // namespace breach::report
