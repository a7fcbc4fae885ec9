// The soil as a flow: depth and mean velocity over x, at gauges and as profile.
// Used for gauges, profiles, front, envelope and sections, so that all of them mean the same depth.
#pragma once

#include <cstdint>
#include <vector>

#include "core/exchange/archive.hpp"
#include "mpm_solver/body/grid.hpp"
#include "mpm_solver/body/points.hpp"

namespace breach::mpm {

/// The mobile soil, and the width over which depths are averaged.
struct FlowView {
    std::vector<std::uint8_t> mobile;  ///< [soils of the scene]
    double width;                      ///< one cell [m]
    double thickness;                  ///< of the section [m]
    double low;                        ///< ends of the grid [m]
    double high;
};

FlowView flow_view(const scene::Scene& scene, const Grid& grid);

struct Flow {
    double depth = 0.0;       ///< soil volume over plan area [m]
    double velocity = 0.0;    ///< mass-weighted mean of v_x; 0 without soil [m/s]
    std::int32_t points = 0;  ///< number of averaged points
};

/// Mean with the hat function of half width `width` about x, clipped at the grid's ends.
Flow flow_at(const Points& points, const FlowView& view, double x);

/// flow_at for every column of the grid, in one pass over the points.
std::vector<Flow> flow_profile(const Points& points, const FlowView& view);

/// Fewer points within a cell of a column are grains and no flow: a layer one point thick has four.
inline constexpr std::int32_t fewest_points_of_a_flow = 3;

/// Zero if there are only grains.
Flow without_grains(const Flow& flow);
std::vector<Flow> without_grains(std::vector<Flow> profile);

/// Largest |velocity| of the readings with at least this depth; soil thrown ahead of a flow is
/// faster. 0 if there are none [m/s].
double fastest_of(const std::vector<double>& depths, const std::vector<double>& velocities,
                  double depth);

/// x of the columns of a profile [m].
std::vector<double> profile_places(const FlowView& view);

/// Surface below the flow at the same columns [m]: `bottom` (floor or terrain) plus the depth of
/// immobile soil.
std::vector<double> ground_profile(const Points& points, const FlowView& view,
                                   std::vector<double> bottom);

/// Top of the highest soil, mobile or not, within half a cell of each column [m]; `ground` if there
/// is none. Soil in flight counts: compare with the depth.
std::vector<double> surface_profile(const Points& points, const FlowView& view,
                                    std::vector<double> ground);

/// Front of a flow that is nowhere deep enough: a finite number, for checkpoints [m].
inline constexpr double nowhere = -1e30;

/// Farthest x with this flow depth, linear between columns [m]; or `nowhere`.
double front_of(const std::vector<Flow>& profile, const FlowView& view, double depth);

/// Profiles at several times, one after the other.
struct Profiles {
    std::vector<double> times;
    std::vector<double> depths;
    std::vector<double> velocities;

    void add(double time, const std::vector<Flow>& profile);
};

/// Stores and loads "<prefix>profile.x", "<prefix>profile.times" and so on.
void store(const Profiles& profiles, const FlowView& view, const std::string& prefix,
           exchange::Archive& archive);
Profiles load_profiles(const exchange::Archive& archive, const std::string& prefix);

}  // namespace breach::mpm
