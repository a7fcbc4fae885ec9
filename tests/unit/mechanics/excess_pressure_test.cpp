// Excess pore pressure as average of element averages: alternating parts cancel, uniform ones stay.
#include "core/mechanics/excess_pressure.hpp"

#include <gtest/gtest.h>

namespace breach::mechanics {
namespace {

/// 4 x 3 skewed quads on 5 x 4 nodes; the lowest row of nodes and elements comes first.
struct Grid {
    std::vector<Vec2> nodes;
    std::vector<std::array<std::int32_t, 4>> quads;

    Grid() {
        for (int j = 0; j < 4; ++j) {
            for (int i = 0; i < 5; ++i) nodes.emplace_back(i + 0.2 * j, j * (1.0 + 0.1 * i));
        }
        for (int j = 0; j < 3; ++j) {
            for (int i = 0; i < 4; ++i) {
                const int n = 5 * j + i;
                quads.push_back({n, n + 1, n + 6, n + 5});
            }
        }
    }
    std::vector<double> excess(const std::vector<double>& p, const std::vector<double>& p_0) const {
        return nodal_excess_pressure(nodes, quads, p, p_0);
    }
};

TEST(ExcessPressure, LosesWhatAlternatesFromNodeToNode) {
    const Grid grid;
    const std::vector<double> p_0(20, 50e3);
    std::vector<double> p;
    for (int n = 0; n < 20; ++n) p.push_back(60e3 + ((n / 5 + n % 5) % 2 == 0 ? 30e3 : -30e3));
    for (const double each : grid.excess(p, p_0)) EXPECT_NEAR(each, 10e3, 1e-9);
}

TEST(ExcessPressure, CountsOnlyElementsThatAreWet) {
    const Grid grid;
    std::vector<double> p_0(20, 50e3), p(20, 80e3);
    for (int n = 10; n < 20; ++n) p_0[n] = p[n] = 0.0;  // dry above the second row of nodes
    const std::vector<double> excess = grid.excess(p, p_0);
    EXPECT_NEAR(excess[2], 30e3, 1e-9) << "the lowest row is wet throughout";
    EXPECT_NEAR(excess[12], 15e3, 1e-9) << "drained above, half full below";
    EXPECT_EQ(excess[17], 0.0) << "dry elements alone";
}

}  // namespace
}  // namespace breach::mechanics
