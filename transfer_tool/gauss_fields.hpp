// Stress and strain from Gauss points to material points, by radial basis functions.
#pragma once

#include "transfer_tool/points.hpp"
#include "transfer_tool/scattered.hpp"

namespace breach::transfer {

/// The mesh's Gauss points, in the elements' shapes used for the points.
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

/// Error of a round trip: the points' fields interpolated back to the Gauss points, compared with
/// the snapshot.
struct RoundTrip {
    double stress_rms = 0.0;      ///< over Gauss points and components [Pa]
    double stress_largest = 0.0;  ///< [Pa]
    double stress_scale = 0.0;    ///< rms of the snapshot [Pa]
    double epsilon_q_rms = 0.0;   ///< [-]
    double velocity_rms = 0.0;    ///< at the nodes: sum m N v / sum m N minus the mesh's [m/s]
    double velocity_scale = 0.0;  ///< rms of the mesh [m/s]
};
/// If the points are the Gauss points, their values are recovered exactly.
std::optional<RoundTrip> round_trip(const exchange::MeshSnapshot& mesh,
                                    const scene::Transfer& settings, const Work& work,
                                    const Points& points);

}  // namespace breach::transfer
