#include "core/grid/kernel.hpp"

#include <gtest/gtest.h>

namespace breach::grid {
namespace {

constexpr WallRows walls{.low = 1, .high = 7};

void expect_complete(const GimpKernel& kernel) {
    for (int k = 0; k <= 6000; ++k) {
        const double xi = 1.0 + k / 1000.0;
        const auto s = kernel(xi, walls);
        double sum = 0.0;
        double first = 0.0;
        double d_sum = 0.0;
        double d_first = 0.0;
        for (int i = 0; i < 3; ++i) {
            EXPECT_GE(s.N[i], 0.0) << xi;
            sum += s.N[i];
            first += s.N[i] * (s.first + i);
            d_sum += s.dN[i];
            d_first += s.dN[i] * (s.first + i);
        }
        EXPECT_NEAR(sum, 1.0, 1e-14) << xi;
        EXPECT_NEAR(first, s.centre, 1e-13) << xi;
        EXPECT_NEAR(d_sum, 0.0, 1e-14) << xi;
        EXPECT_NEAR(d_first, 1.0, 1e-13) << xi;
        // No weights beyond the walls.
        if (s.first < walls.low) {
            EXPECT_EQ(s.N[0], 0.0) << xi;
        }
        if (s.first + 2 > walls.high) {
            EXPECT_EQ(s.N[2], 0.0) << xi;
        }
    }
}

TEST(Kernel, GimpSumsToOneAndReproducesLinearFieldsUpToTheWalls) {
    for (const double l : {0.1, 0.25, 0.5}) expect_complete(GimpKernel(l));
}

/// The top of a bed is a wall for the bed's soil only, and only below it.
void expect_end_of_a_bed(const GimpKernel& kernel) {
    const WallRows bed{.low = 1, .high = 4};
    for (int k = 1; k < 1000; ++k) {
        const double d = k / 1000.0;
        const auto below = kernel(4.0 - d, bed);
        for (int i = 0; i < 3; ++i) {
            if (below.first + i > bed.high) {
                EXPECT_EQ(below.N[i], 0.0) << d;
            }
        }
        const auto above = kernel(4.0 + d, bed);
        const auto free = kernel(4.0 + d, WallRows{.low = 1});
        for (int i = 0; i < 3; ++i) {
            EXPECT_EQ(above.N[i], free.N[i]) << d;
            EXPECT_EQ(above.dN[i], free.dN[i]) << d;
        }
    }
}

TEST(Kernel, DomainsEndAtTheTopOfABedAndAreFreeBeyondIt) {
    for (const double l : {0.1, 0.25, 0.5}) expect_end_of_a_bed(GimpKernel(l));
}

TEST(Kernel, GimpIsContinuousThroughTheCellAndAtTheClip) {
    const GimpKernel kernel(0.25);
    const auto weight = [&](double xi, int node) {
        const auto s = kernel(xi, walls);
        const int i = node - static_cast<int>(s.first);
        return i >= 0 && i < 3 ? s.N[i] : 0.0;
    };
    for (int node = 1; node <= 7; ++node) {
        for (int k = 0; k < 6000; ++k) {
            const double xi = 1.0 + k / 1000.0;
            EXPECT_NEAR(weight(xi, node), weight(xi + 1e-3, node), 1.1e-3) << xi;
        }
    }
}

TEST(Kernel, GimpInTheInteriorIsBardenhagenAndKobers) {
    const double l = 0.25;
    const GimpKernel kernel(l);
    const auto exact = [l](double r) {
        r = std::abs(r);
        if (r < l) return 1.0 - (r * r + l * l) / (2.0 * l);
        if (r < 1.0 - l) return 1.0 - r;
        return r < 1.0 + l ? (1.0 + l - r) * (1.0 + l - r) / (4.0 * l) : 0.0;
    };
    for (int k = 0; k < 1000; ++k) {
        const double xi = 3.0 + k / 1000.0;
        const auto s = kernel(xi, walls);
        for (int i = 0; i < 3; ++i) EXPECT_NEAR(s.N[i], exact(xi - (s.first + i)), 1e-14) << xi;
    }
}

}  // namespace
}  // namespace breach::grid
