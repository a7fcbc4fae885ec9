#include "lem_tool/strata.hpp"

#include <gtest/gtest.h>

#include "tests/unit/lem/small_scenes.hpp"

namespace breach::lem {
namespace {

using small::json;

TEST(Strata, HasOneStripBetweenVerticesAndLayersFromTheGroundDown) {
    const Strata strata = make_strata(small::parsed(small::two_layers(small::some_circle())));
    ASSERT_EQ(strata.strips.size(), 3u);  // 0-20, 20-40, 40-60
    EXPECT_EQ(strata.strips[0].last - strata.strips[0].first, 2u);
    EXPECT_EQ(strata.strips[2].last - strata.strips[2].first, 1u);
    EXPECT_EQ(strata.layers[strata.strips[0].first].region, 1u);
    EXPECT_DOUBLE_EQ(ground_level(strata, 30.0, From::left), 5.0);
    EXPECT_DOUBLE_EQ(ground_level(strata, 50.0, From::right), 0.0);
    EXPECT_DOUBLE_EQ(strata.strips[1].bottom.at(30.0), -5.0);
}

TEST(Strata, WeightAboveALayerIsThatOfEverythingOnIt) {
    const Strata strata = make_strata(small::parsed(small::two_layers(small::some_circle())));
    const Strip& slope = strata.strips[1];
    const Layer& base = strata.layers[slope.first + 1];
    EXPECT_NEAR(base.weight_above.at(24.0), 20e3 * 8.0, 1e-6);
    EXPECT_NEAR(base.weight_above.at(40.0), 0.0, 1e-6);
}

TEST(Strata, FastSoilTakesItsEffectiveWeightAlone) {
    // Left of the crest 10 m of fill with 20 kN/m3 are on the base; the water in it was there
    // before.
    const auto taken = [](const json& water) {
        json text = small::two_layers(small::some_circle());
        text["lem"]["unconsolidated"] = {"fill"};
        if (!water.is_null()) text["lem"]["water"] = {{"line", water}};
        const Strata strata = make_strata(small::parsed(text));
        return strata.layers[strata.strips[0].first + 1].unconsolidated.at(10.0);
    };
    EXPECT_NEAR(taken(json()), 200e3, 1e-6);
    EXPECT_NEAR(taken({{0, 0}, {60, 0}}), 200e3, 1e-6);
    EXPECT_NEAR(taken({{0, 4}, {20, 4}, {40, 0}, {60, 0}}), 160e3, 1e-6);
    EXPECT_NEAR(taken({{0, 12}, {60, 12}}), 100e3, 1e-6) << "a pond above it is none of its weight";
}

TEST(Strata, VerticalFaceHasTwoLevels) {
    const auto scene = small::parsed(
        small::scene({{"clay", small::soil(20, 50, 0)}},
                     json::array({small::region(
                         "clay", "clay", {{0, -5}, {40, -5}, {40, 8}, {20, 8}, {20, 0}, {0, 0}})}),
                     small::some_circle()));
    const Strata strata = make_strata(scene);
    EXPECT_EQ(ground_level(strata, 20.0, From::left), 0.0);
    EXPECT_EQ(ground_level(strata, 20.0, From::right), 8.0);
}

TEST(Strata, RefusesAnOverhangAndACavity) {
    const auto overhang = small::parsed(small::scene(
        {{"clay", small::soil(20, 50, 0)}},
        json::array({small::region(
            "clay", "clay",
            {{0, -5}, {40, -5}, {40, 8}, {15, 8}, {15, 6}, {20, 6}, {20, 0}, {0, 0}})}),
        small::some_circle()));
    EXPECT_THROW(make_strata(overhang), fault::BadInput);
    const auto apart = small::parsed(small::scene(
        {{"clay", small::soil(20, 50, 0)}},
        json::array({small::region("low", "clay", {{0, -5}, {40, -5}, {40, 0}, {0, 0}}),
                     small::region("high", "clay", {{0, 2}, {20, 2}, {20, 8}, {0, 8}})}),
        small::some_circle()));
    EXPECT_THROW(make_strata(apart), fault::BadInput);
}

TEST(Strata, ClosesGapsOfDrawingInaccuracy) {
    const auto sloppy = small::parsed(small::scene(
        {{"clay", small::soil(20, 50, 0)}},
        json::array({small::region("low", "clay", {{0, -5}, {40, -5}, {40, 0}, {0, 0}}),
                     small::region("high", "clay", {{0, 0.002}, {30, 0.001}, {20, 8}, {0, 8}})}),
        small::some_circle()));
    const Strata strata = make_strata(sloppy);
    const Layer& low = strata.layers[strata.strips[0].first + 1];
    EXPECT_NEAR(low.weight_above.at(10.0), 20e3 * 8.0, 1e-6);
}

}  // namespace
}  // namespace breach::lem
