// Stress and strain from the mesh's Gauss points to the material points, by radial basis functions.
#pragma once

#include "core/scene/scene.hpp"
#include "transfer_tool/points.hpp"
#include "transfer_tool/rbf.hpp"

namespace breach::transfer {

/// What the interpolation had to do beside interpolating.
struct GaussFieldReport {
    std::size_t merged_centres = 0;          ///< coincident Gauss points that were taken as one
    std::size_t raised_strains = 0;          ///< epsilon_q below zero, set to zero
    std::size_t smallest_neighbourhood = 0;  ///< fewest centres that any element had; local only
};

/// Fills stress, epsilon_q and epsilon_q_plastic. Centres and points lie in the deformed mesh.
///
/// local: one interpolant per element through the `neighbours` Gauss points of its region that are
/// nearest to its centre, so nothing crosses a region's border, memory is linear in the number of
/// points and the result does not depend on the number of threads. A point at a Gauss point takes
/// its value. paper: one interpolant through all Gauss points of the mesh. Throws BadInput when
/// they are too many for a dense system.
GaussFieldReport carry_gauss_fields(const exchange::MeshSnapshot& mesh,
                                    const scene::Transfer& settings, int threads, Points& points);

/// The same for any fields: one row per Gauss point in, one row per material point out.
struct Interpolated {
    Values value;
    GaussFieldReport report;
};
Interpolated interpolate(const exchange::MeshSnapshot& mesh, const Values& at_gauss,
                         const scene::Transfer& settings, int threads, const Points& points);

}  // namespace breach::transfer
