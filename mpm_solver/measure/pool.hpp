// Flags of standing water at the end of a run: what its still pressure leaves out.
#pragma once

#include "core/fault/flag.hpp"
#include "mpm_solver/body/body.hpp"
#include "mpm_solver/measure/flow.hpp"

namespace breach::mpm {

/// Surface below the mobile soil, and top of all soil, at the columns of profile_places [m].
struct Surfaces {
    std::vector<double> ground;
    std::vector<double> top;
};
Surfaces surfaces_of(const scene::Scene& scene, const Body& body, const FlowView& view);

/// Without /mpm/water none. `standing_water`: the runout is an upper bound. `scarp_without_pool`:
/// the soil's top fell below the pool where the pressure is that of the dam's pores.
/// `pool_runs_over`: no soil is left above the pool.
std::vector<fault::Flag> flags_of_pool(const scene::Scene& scene, const Body& body,
                                       const FlowView& view, const Surfaces& surfaces);

}  // namespace breach::mpm
