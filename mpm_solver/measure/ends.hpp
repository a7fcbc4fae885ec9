// Ends of the model within the flow: walls reached by the flow, the end of the firm ground, the
// upstream end reached by the failure.
// Checked by write_results at the end of a run. Each of them shortens or falsifies a runout without
// any other sign.
#pragma once

#include "core/fault/flag.hpp"
#include "mpm_solver/measure/envelope.hpp"

namespace breach::mpm {

/// Depths of the mobile soil over the columns of profile_places [m].
struct Depths {
    std::vector<double> first;    ///< at time 0
    std::vector<double> largest;  ///< maximum so far
    std::vector<double> last;     ///< present
};

/// Flags `reached_wall` and `upstream_wall`.
std::vector<fault::Flag> flags_of_ends(const scene::Scene& scene, const FlowView& view,
                                       const Depths& depths);

}  // namespace breach::mpm
