// Motion of the ground from the FEM's first dynamic stage to the end of the earthquake. Needed by a
// runout that begins while the ground still shakes.
#pragma once

#include <vector>

namespace breach::exchange {

/// Horizontal velocity of the base beneath the free-field columns, which do not fail.
struct BaseMotion {
    double time_step = 0.0;        ///< samples at 0, time_step, 2 time_step, ... [s]
    std::vector<double> velocity;  ///< relative to far rock at rest [m/s]; empty: unknown

    bool any() const { return !velocity.empty(); }
};

}  // namespace breach::exchange
