// Runout of the soil, by exact definitions.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "mpm_solver/body/points.hpp"

namespace breach::mpm {

/// Distances beyond the toe [m], of the mobile regions only.
struct Runout {
    double all = 0.0;        ///< mass-weighted 99th percentile of signed x - x_toe over all of it
    double beyond = 0.0;     ///< the same over the soil at x > x_toe; 0 when there is none
    double beyond_95 = 0.0;  ///< 95th percentile of it
    double beyond_50 = 0.0;  ///< its median
    double largest = 0.0;    ///< of any point
    double all_by_count = 0.0;   ///< 99th percentile over all points, not weighted by mass
    double volume_beyond = 0.0;  ///< of soil at x > x_toe [m3]
};

/// Whether the soil of each region of the section counts for the runout.
std::vector<std::uint8_t> mobile_regions(const scene::Scene& scene);

Runout runout_of(const Points& points, const std::vector<std::uint8_t>& mobile, double toe_x);

/// Mass-weighted percentile of pairs (x, mass) that ascend in x: the least x such that the mass at
/// or below it is at least `share` of the whole; 0 when there are none.
double percentile(std::span<const std::pair<double, double>> x_and_mass, double share);

}  // namespace breach::mpm
