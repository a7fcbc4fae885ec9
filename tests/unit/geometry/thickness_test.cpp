#include "core/geometry/thickness.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace breach::geometry {
namespace {

Polygon turned(const Polygon& polygon, double angle) {
    Polygon result;
    for (const auto& p : polygon)
        result.emplace_back(std::cos(angle) * p.x() - std::sin(angle) * p.y(),
                            std::sin(angle) * p.x() + std::cos(angle) * p.y());
    return result;
}

TEST(Thickness, OfABandIsItsOwnHoweverLongAndHoweverItLies) {
    for (const double length : {10.0, 100.0, 1000.0}) {
        const Polygon band{{0, 0}, {length, 0}, {length, 5}, {0, 5}};
        for (const double angle : {0.0, 0.3, 1.2})
            EXPECT_NEAR(thickness_of(turned(band, angle)), 5.0, 0.1) << length << " " << angle;
    }
    EXPECT_NEAR(thickness_of({{0, 0}, {1000, 0}, {1000, 0.1}, {0, 0.1}}), 0.1, 0.002);
}

TEST(Thickness, OfASquareIsItsEdgeAndOfASlopeItsHeight) {
    EXPECT_NEAR(thickness_of({{0, 0}, {10, 0}, {10, 10}, {0, 10}}), 10.0, 0.3);
    EXPECT_NEAR(thickness_of({{0, 0}, {30, 0}, {20, 10}, {0, 10}}), 10.0, 0.3);
}

TEST(Thickness, OfABentBandIsNotTheWidthOfItsHull) {
    const Polygon bent{{0, 0}, {50, 0}, {50, 50}, {47, 50}, {47, 3}, {0, 3}};
    EXPECT_NEAR(thickness_of(bent), 3.0, 0.1);
}

TEST(Thickness, OfALumpWithATailIsTheLumpsWhenMostOfTheSoilIsThere) {
    const Polygon lump{{0, 0}, {40, 0}, {40, 1}, {10, 1}, {10, 10}, {0, 10}};
    EXPECT_NEAR(thickness_of(lump), 10.0, 0.5);
}

TEST(Thickness, OfALayerOfALargerMassIsTheMasss) {
    // The lower layer is longer: the edges share a part.
    const Polygon lower{{-10, 0}, {40, 0}, {40, 3}, {30, 3}, {0, 3}, {-10, 3}};
    const Polygon upper{{0, 3}, {30, 3}, {30, 10}, {0, 10}};
    EXPECT_NEAR(thickness_of(lower, {upper}), 10.0, 0.3);
    EXPECT_NEAR(thickness_of(upper, {lower}), 10.0, 0.3);
    EXPECT_NEAR(thickness_of(lower), 3.0, 0.1);
}

TEST(Thickness, BelowALimitIsTheSameAndNothingElse) {
    const Polygon lump{{0, 0}, {40, 0}, {40, 1}, {10, 1}, {10, 10}, {0, 10}};
    const double whole = thickness_of(lump);
    EXPECT_EQ(thickness_below(1.01 * whole, lump), whole);
    EXPECT_FALSE(thickness_below(whole, lump));
    EXPECT_FALSE(thickness_below(0.5, lump));
}

}  // namespace
}  // namespace breach::geometry
