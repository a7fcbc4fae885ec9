// Scatter of a curve about itself: estimates noise without repeats.
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace breach::statistics {

struct CurvePoint {
    double x, y;
};

inline constexpr int neighbours_each_side = 2;

/// Standard deviation of each sample about the line through its two neighbours (Gasser, Sroka &
/// Jennen-Steinmetz 1986), root mean square over the sample and `neighbours_each_side` on either
/// side. Includes the curve's curvature there. None if fewer than three samples have two
/// neighbours. `samples` ascend in x.
std::vector<std::optional<double>> scatter_among_neighbours(std::span<const CurvePoint> samples);

}  // namespace breach::statistics
