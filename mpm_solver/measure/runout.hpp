// Runout of the soil, by exact definitions.
// Definitions for users: docs/reference/methods/runout.md. Signed distances: the 99th percentile of
// their absolute values would be the far end of the pond.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "mpm_solver/body/points.hpp"

namespace breach::mpm {

/// Distances from the toe [m], of the mobile regions.
struct Runout {
    double all = 0.0;  ///< mass-weighted 99th percentile of signed x - x_toe over all mobile soil
    double beyond = 0.0;         ///< the same over the soil at x > x_toe; 0 if there is none
    double beyond_95 = 0.0;      ///< 95th percentile
    double beyond_50 = 0.0;      ///< median
    double largest = 0.0;        ///< of any point
    double all_by_count = 0.0;   ///< 99th percentile over all points, not weighted by mass
    double volume_beyond = 0.0;  ///< of soil at x > x_toe [m3]
};

/// [regions] whether it counts for the runout.
std::vector<std::uint8_t> mobile_regions(const scene::Scene& scene);

Runout runout_of(const Points& points, const std::vector<std::uint8_t>& mobile, double toe_x);

/// Mass-weighted percentile of pairs (x, mass), ascending in x: the least x with at least `share`
/// of the mass at or below it; 0 without pairs.
double percentile(std::span<const std::pair<double, double>> x_and_mass, double share);

}  // namespace breach::mpm
