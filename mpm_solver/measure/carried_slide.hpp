// A slide that stress waves carried: soil that keeps its shape slid on a floor whose friction took
// less than Coulomb says.
// The runout cannot show it: it looks like any other slide. write_results checks each finished run.
#pragma once

#include <optional>

#include "core/fault/flag.hpp"
#include "mpm_solver/body/body.hpp"
#include "mpm_solver/measure/energy.hpp"
#include "mpm_solver/measure/flow.hpp"

namespace breach::mpm {

struct Travel {
    Energy start, end;
    double mean, front;  ///< of the mobile soil and of its 99th percentile, in x [m]
};

/// Flag `carried_slide`, if the mobile soil slid as one body (mean and front alike, most of the
/// energy taken by the floor), and friction took less than m g mu L, with the smallest mu on its
/// way. Where stress waves change the normal force, soil slides while that is small; the more, the
/// smaller the margin and the damping.
std::optional<fault::Flag> flag_of_carried_slide(const scene::Scene& scene, const Body& body,
                                                 const FlowView& view, const Travel& travel);

}  // namespace breach::mpm
