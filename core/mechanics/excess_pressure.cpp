#include "core/mechanics/excess_pressure.hpp"

#include <algorithm>
#include <cmath>

namespace breach::mechanics {

std::vector<double> nodal_excess_pressure(std::span<const Vec2> nodes,
                                          std::span<const std::array<std::int32_t, 4>> quads,
                                          std::span<const double> p, std::span<const double> p_0) {
    std::vector<double> sum(nodes.size(), 0.0), area(nodes.size(), 0.0);
    for (const auto& quad : quads) {
        const bool wet = std::ranges::any_of(quad, [&](std::int32_t i) { return p_0[i] != 0.0; });
        if (!wet) continue;
        double mean = 0.0;
        for (const std::int32_t i : quad) mean += 0.25 * (p[i] - p_0[i]);
        const Vec2 a = nodes[quad[2]] - nodes[quad[0]], b = nodes[quad[3]] - nodes[quad[1]];
        const double A = 0.5 * std::abs(a.x() * b.y() - a.y() * b.x());
        for (const std::int32_t i : quad) {
            sum[i] += A * mean;
            area[i] += A;
        }
    }
    for (std::size_t i = 0; i < sum.size(); ++i) {
        if (area[i] > 0.0) sum[i] /= area[i];
    }
    return sum;
}

}  // namespace breach::mechanics
