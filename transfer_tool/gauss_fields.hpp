// Stress and strain from Gauss points to material points, by radial basis functions.
// Unlike velocity and pore pressure, stress and strain exist at Gauss points only: no shape
// functions can give them, and they may jump between elements.
#pragma once

#include "transfer_tool/points.hpp"
#include "transfer_tool/scattered.hpp"

namespace breach::transfer {

/// The mesh's Gauss points, in the elements' shapes used for the points.
/// In the order of the mesh's Gauss fields: element by element.
Sources gauss_points(const exchange::MeshSnapshot& mesh, const Points& points);

/// Interpolates fields: one row per Gauss point in, one row per material point out. A point at a
/// Gauss point gets its values. None if stopped by the watch.
std::optional<Interpolated> interpolate(const exchange::MeshSnapshot& mesh, const Values& at_gauss,
                                        const scene::Transfer& settings, const Work& work,
                                        const Points& points);

/// Sets effective_stress, epsilon_q and epsilon_q_plastic.
std::optional<GaussFieldReport> carry_gauss_fields(const exchange::MeshSnapshot& mesh,
                                                   const scene::Transfer& settings,
                                                   const Work& work, Points& points);

}  // namespace breach::transfer
