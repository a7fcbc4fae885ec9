// Every scene gets a factor of safety or a clear refusal.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/lem/small_scenes.hpp"

namespace breach::lem {
namespace {

using small::json;

Cut verdict_on(const json& text) {
    const auto scene = small::parsed(text);
    const Model model = make_model(scene);
    Slices slices = make_slices(model.strata, model.slices);
    Cut verdict = Cut::above_ground;
    for (const Surface& surface : masses_of(model.strata, *scene.lem->circle)) {
        verdict = cut(model.strata, model.soils, surface, model.slices, slices);
    }
    return verdict;
}

json circle(double x, double y, double R) {
    return {{"circle", {{"center", {x, y}}, {"radius", R}}}};
}

TEST(Extreme, CircleThatMissesTheGroundCutsNothingOff) {
    const auto scene = small::parsed(small::two_layers(circle(30, 100, 20)));
    EXPECT_TRUE(masses_of(make_model(scene).strata, *scene.lem->circle).empty());
}

TEST(Extreme, CircleBelowTheModelIsRefused) {
    EXPECT_EQ(verdict_on(small::two_layers(circle(33, 18, 30))), Cut::leaves_model);
}

TEST(Extreme, CircleThroughTheModelsSideIsRefused) {
    EXPECT_EQ(verdict_on(small::two_layers(circle(58, 10, 12))), Cut::leaves_model);
}

TEST(Extreme, CircleCentredBelowTheCrestIsRefused) {
    EXPECT_EQ(verdict_on(small::two_layers(circle(22, 4, 8))), Cut::overhangs);
}

TEST(Extreme, LinearElasticRegionLetsNoSurfacePass) {
    json text = small::two_layers(small::some_circle());
    text["materials"]["base"] = small::rock(18);
    EXPECT_EQ(verdict_on(text), Cut::closed_region);
    text["lem"] = small::some_search();
    const auto scene = small::parsed(text);
    const auto found = search(make_model(scene), *scene.lem->search);
    const Surface& s = found.critical.value().surface;
    EXPECT_GE(s.circle.center.y() - s.circle.radius, -1e-6) << "stays above the rock at y = 0";
}

TEST(Extreme, VerticalFaceIsAnalysed) {
    const auto scene = small::parsed(small::scene(
        {{"clay", small::soil(20, 50, 0)}},
        json::array({small::region("clay", "clay",
                                   {{-20, -5}, {40, -5}, {40, 8}, {0, 8}, {0, 0}, {-20, 0}})}),
        {{"search", {{"entry", {1, 30}}, {"exit", {-1e-6, 0}}}}}));
    const auto found = search(make_model(scene), *scene.lem->search);
    // Fellenius: 3.83 c / (gamma H); toe circles of the vertical cut
    EXPECT_NEAR(found.critical.value().bishop.factor_of_safety, 3.83 * 50.0 / (20.0 * 8.0), 0.005);
}

TEST(Extreme, SoilWithoutStrengthHasNoFactorLeft) {
    json text = small::two_layers(small::some_circle());
    text["materials"]["fill"] = small::soil(20, 0, 0);
    text["materials"]["base"] = small::soil(20, 0, 0);
    EXPECT_EQ(small::circle_bishop(small::parsed(text)).factor_of_safety, 0.0);
}

TEST(Extreme, NoGravityDrivesNothing) {
    json text = small::two_layers(small::some_circle());
    text["gravity"] = 0.0;
    EXPECT_EQ(small::circle_bishop(small::parsed(text)).balance, Balance::no_driving_moment);
}

TEST(Extreme, FrictionlessBesideVeryFrictionalSoilGivesANumberOrSaysWhyNot) {
    for (const double phi : {0.0, 45.0, 80.0, 89.0}) {
        for (const double radius : {16.0, 19.0, 22.9}) {
            json text = small::two_layers(circle(33, 18, radius));
            text["materials"]["fill"] = small::soil(20, 0.1, 89.0 - phi);
            text["materials"]["base"] = small::soil(20, 30, phi);
            const Bishop result = small::circle_bishop(small::parsed(text));
            ASSERT_NE(result.balance, Balance::not_converged);
            ASSERT_TRUE(std::isfinite(result.factor_of_safety));
            ASSERT_GT(result.m_alpha, 0.0) << "the root lies where every m_alpha is positive";
        }
    }
}

TEST(Extreme, TwoHundredLayersAreCutAtEveryOne) {
    json regions = json::array();
    for (int k = 0; k < 200; ++k) {
        const double low = -5.0 + 0.075 * k;
        const double high = low + 0.075;
        const auto right = [](double y) { return y <= 0.0 ? 60.0 : 40.0 - 2.0 * y; };
        small::Ring ring{{0, low}, {right(low), low}, {right(high), high}, {0, high}};
        if (low < 0.0 && high > 1e-12) {
            ring = {{0, low}, {60, low}, {60, 0}, {40, 0}, {right(high), high}, {0, high}};
        }
        regions.push_back(
            small::region(std::string("layer").append(std::to_string(k)), k % 2 ? "a" : "b", ring));
    }
    const auto striped =
        small::parsed(small::scene({{"a", small::soil(20, 10, 20)}, {"b", small::soil(20, 10, 20)}},
                                   regions, small::some_circle()));
    const auto plain = small::parsed(small::scene(
        {{"a", small::soil(20, 10, 20)}},
        json::array(
            {small::region("all", "a", {{0, -5}, {60, -5}, {60, 0}, {40, 0}, {20, 10}, {0, 10}})}),
        small::some_circle()));
    const double F = small::circle_bishop(plain).factor_of_safety;
    const double same = small::circle_bishop(striped).factor_of_safety;
    // Hundreds of slices against 50: the error with 50 is 1e-4.
    EXPECT_NEAR(same, F, 5e-4 * F);
}

TEST(Extreme, LayersLiquefiedToNothingLeaveAFactorNearNothing) {
    json text = small::two_layers(small::some_search());
    text["lem"]["liquefaction"] = {{{"region", "fill"}}, {{"region", "base"}}};  // s_r = 0
    const auto scene = small::parsed(text);
    Model model = make_model(scene);
    model.soils = liquefied(model, scene.lem->liquefaction, 2);
    const auto found = search(model, *scene.lem->search);
    EXPECT_EQ(found.critical.value().bishop.factor_of_safety, 0.0);
}

TEST(Extreme, LayerWithoutThicknessChangesNothingOrIsRefused) {
    json text = small::two_layers(small::some_circle());
    const double F = small::circle_bishop(small::parsed(text)).factor_of_safety;
    for (const double thickness : {1e-3, 1e-6, 1e-10}) {
        json thin = text;
        thin["materials"]["seam"] = small::soil(20, 8, 25);
        thin["section"]["regions"].push_back(small::region(
            "seam", "seam", {{0, 10}, {20, 10}, {20, 10 + thickness}, {0, 10 + thickness}}));
        try {
            const Bishop with = small::circle_bishop(small::parsed(thin));
            EXPECT_NEAR(with.factor_of_safety, F, 2e-3 * F) << thickness;
        } catch (const fault::BadInput& refused) {
            EXPECT_LT(thickness, 1e-9) << refused.what();
        }
    }
}

TEST(Extreme, GroundDeepUnderWaterHasAFactor) {
    for (const double level : {10.0, 50.0, 1000.0}) {
        json text = small::two_layers(small::some_search());
        text["lem"]["water"] = {{"line", {{0, level}}}};
        const auto scene = small::parsed(text);
        const auto found = search(make_model(scene), *scene.lem->search);
        const double F = found.critical.value().bishop.factor_of_safety;
        EXPECT_TRUE(std::isfinite(F));
        EXPECT_GT(F, 1.0) << level;
    }
}

TEST(Extreme, SearchWithNothingToFindSaysSo) {
    json text = small::two_layers(small::some_search());
    text["lem"]["search"]["minimum_depth"] = 1000.0;
    const auto scene = small::parsed(text);
    const auto found = search(make_model(scene), *scene.lem->search);
    EXPECT_FALSE(found.critical.has_value());
    EXPECT_GT(found.tally.too_shallow, 0);
}

}  // namespace
}  // namespace breach::lem
