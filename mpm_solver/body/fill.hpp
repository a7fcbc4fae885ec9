// Fills the section with material points at rest, without stress or under the overburden, for runs
// without transfer.
#pragma once

#include <string>
#include <vector>

#include "core/exchange/particle_state.hpp"
#include "core/scene/scene.hpp"

namespace breach::mpm {

/// Compares a region with its points: a head of water sampled 2 % too high runs 2 % too far.
struct SampledRegion {
    std::string name;
    double polygon_area;   ///< [m2]
    double sampled_area;   ///< sum of the points' areas [m2]
    double polygon_level;  ///< height of the centroid [m]
    double sampled_level;
    double height;  ///< of the polygon [m]
    std::size_t points;
};

/// Area within 1 %, and centroid within 1 % of the polygon's height.
bool is_faithful(const SampledRegion& region);

/// Every region of the scene that has points.
std::vector<SampledRegion> sampling_of(const scene::Scene& scene,
                                       const exchange::ParticleState& state);

struct FilledSection {
    exchange::ParticleState state;
    std::vector<SampledRegion> regions;
};

/// Divides cells into fill_points^2 equal squares. Each becomes a point with the area and centroid
/// of its part inside the polygon, so areas and first moments are exact. Slivers join a neighbour.
FilledSection fill_section(const scene::Scene& scene);

}  // namespace breach::mpm
