// Scatter of a curve about itself: an estimate of noise without repeats.
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace breach::statistics {

struct CurvePoint {
    double x, y;
};

inline constexpr int neighbours_each_side = 2;

/// Standard deviation of each sample about the straight line through its two neighbours (Gasser, Sroka
/// & Jennen-Steinmetz 1986), root mean square over itself and `neighbours_each_side` to either side.
/// Includes bends of the curve within them. Nothing where fewer than three samples have two
/// neighbours. `samples` ascend in x.
std::vector<std::optional<double>> scatter_among_neighbours(std::span<const CurvePoint> samples);

}  // namespace breach::statistics
