#include "lem_tool/slices.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "tests/unit/lem/small_scenes.hpp"

namespace breach::lem {
namespace {

using small::json;

double total(const std::vector<double>& array, std::size_t count) {
    return std::accumulate(array.begin(), array.begin() + static_cast<std::ptrdiff_t>(count), 0.0);
}

scene::Scene level_ground() {
    return small::parsed(small::scene(
        {{"clay", small::soil(20, 50, 10)}},
        json::array({small::region("clay", "clay", {{-20, -20}, {20, -20}, {20, 0}, {-20, 0}})}),
        {{"circle", {{"center", {0, 6}}, {"radius", 10}}}}));
}

TEST(Slices, CircularSegmentHasItsAreaAndArcLength) {
    const scene::Scene scene = level_ground();
    const Model model = make_model(scene);
    Slices slices = make_slices(model.strata, 40);
    const auto masses = masses_of(model.strata, *scene.lem->circle);
    ASSERT_EQ(masses.size(), 1u);
    EXPECT_NEAR(masses[0].left, -8.0, 1e-12);
    ASSERT_EQ(cut(model.strata, model.soils, masses[0], 40, slices), Cut::done);
    const double half = std::acos(0.6);
    const double area = 100.0 * (half - std::sin(half) * std::cos(half));
    EXPECT_NEAR(total(slices.weight, slices.count), 20e3 * area, 1e-6 * 20e3 * area);
    EXPECT_NEAR(total(slices.length, slices.count), 20.0 * half, 1e-6 * 20.0 * half);
    EXPECT_NEAR(total(slices.width, slices.count), 16.0, 1e-12);
    EXPECT_NEAR(slices.depth, 4.0, 1e-12);
    // Level ground has no driving moment.
    EXPECT_EQ(bishop(slices, slide_of(slices), 0.0).balance, Balance::no_driving_moment);
}

TEST(Slices, AreCutWhereTheArcLeavesALayer) {
    const scene::Scene scene = small::parsed(small::two_layers(small::some_circle()));
    const Model model = make_model(scene);
    Slices slices = make_slices(model.strata, 3);
    const Surface surface = masses_of(model.strata, *scene.lem->circle).at(0);
    ASSERT_EQ(cut(model.strata, model.soils, surface, 3, slices), Cut::done);
    const auto is_cut_at = [&](double x) {
        for (std::size_t i = 1; i < slices.count; ++i) {
            if (std::abs(slices.left[i] - x) < 1e-9) return true;
        }
        return false;
    };
    // centre (33, 18), radius 20: meets y = 0 at 33 -+ sqrt(76), and the crest's vertical x = 20
    EXPECT_TRUE(is_cut_at(20.0));
    EXPECT_TRUE(is_cut_at(33.0 - std::sqrt(76.0)));
    for (std::size_t i = 0; i < slices.count; ++i) {
        EXPECT_EQ(slices.c[i], slices.base[i] > 0.0 ? 8e3 : 15e3);
    }
}

TEST(Slices, WeighEveryLayerAboveTheArc) {
    // the same mass with many slices and few: weights are exact, so the sums agree
    const scene::Scene scene = small::parsed(small::two_layers(small::some_circle()));
    const Model model = make_model(scene);
    const Surface surface = masses_of(model.strata, *scene.lem->circle).at(0);
    Slices few = make_slices(model.strata, 12);
    Slices many = make_slices(model.strata, 3000);
    cut(model.strata, model.soils, surface, 12, few);
    cut(model.strata, model.soils, surface, 3000, many);
    const double reference = total(many.weight, many.count);
    EXPECT_NEAR(total(few.weight, few.count), reference, 1e-6 * reference);
    // the moment of a chord's segment is of fourth order in the slice's angle
    EXPECT_NEAR(total(few.driving, few.count), total(many.driving, many.count), 2e-5 * reference);
}

TEST(SlipCircle, ThroughTwoPointsTouchesTheLineItShouldTouch) {
    const Ends ends{{2.0, 10.0}, {30.0, 1.0}};
    for (const Line& line : {Line{-2.0, 0.0}, Line{-6.0, 0.1}, Line{0.0, -0.05}}) {
        const Touching circles = touching(ends, line);
        ASSERT_GT(circles.count, 0);
        for (int i = 0; i < circles.count; ++i) {
            const Surface surface = surface_through(ends, circles.sagitta[i]);
            const double distance =
                (surface.circle.center.y() - line.at(surface.circle.center.x())) /
                std::hypot(1.0, line.slope);
            EXPECT_NEAR(distance, surface.circle.radius, 1e-9);
            EXPECT_NEAR(surface.level(2.0), 10.0, 1e-9);
            EXPECT_NEAR(surface.level(30.0), 1.0, 1e-9);
        }
    }
}

TEST(SlipCircle, DeepestArcStartsVertically) {
    const Ends ends{{2.0, 10.0}, {30.0, 1.0}};
    const Surface surface = surface_through(ends, ends.largest_sagitta());
    EXPECT_NEAR(surface.circle.center.y(), 10.0, 1e-9);
}

// Soil above its phreatic line has no water to liquefy; soil without a line liquefies everywhere.
TEST(Slices, OfALiquefiedLayerKeepTheirStrengthAboveThePhreaticLine) {
    json lem = small::some_search();
    lem.update(small::some_circle());
    lem["liquefaction"] = {{{"region", "fill"}, {"residual_strength_kPa", 2}}};
    const auto slices_with = [](const json& text) {
        const scene::Scene scene = small::parsed(small::two_layers(text));
        const Model model = make_model(scene);
        const std::vector<Soil> soils = liquefied(model, scene.lem->liquefaction, 1);
        Slices slices = make_slices(model.strata, 30);
        const Surface surface = masses_of(model.strata, *scene.lem->circle).at(0);
        EXPECT_EQ(cut(model.strata, soils, surface, 30, slices), Cut::done);
        return slices;
    };
    json wet = lem;
    wet["water"] = {{"line", {{0, 4}, {60, 4}}}};
    const Slices slices = slices_with(wet);
    std::size_t above = 0, below = 0;
    for (std::size_t i = 0; i < slices.count; ++i) {
        if (slices.base[i] < 0.0) {
            EXPECT_EQ(slices.c[i], 15e3);
            continue;
        }
        const bool dry = slices.base[i] > 4.0;
        EXPECT_EQ(slices.c[i], dry ? 8e3 : 2e3) << slices.base[i];
        EXPECT_NEAR(slices.tan_phi[i], dry ? std::tan(25.0 * M_PI / 180.0) : 0.0, 1e-12);
        (dry ? above : below) += 1;
    }
    EXPECT_GT(above, 3u);
    EXPECT_GT(below, 3u);
    const Slices dry = slices_with(lem);
    for (std::size_t i = 0; i < dry.count; ++i)
        EXPECT_EQ(dry.c[i], dry.base[i] < 0.0 ? 15e3 : 2e3) << "no line at all";
}

}  // namespace
}  // namespace breach::lem
