// A wider search finds no higher factor of safety, as it includes the narrower one.
#include <gtest/gtest.h>

#include <cmath>

#include "lem_tool/limit_scene.hpp"
#include "tests/unit/lem/small_scenes.hpp"

namespace breach::lem {
namespace {

using small::json;

// relative; a tenth of the resolution with 50 slices
constexpr double allowed = 1e-5;

double least_factor(const Model& model, const scene::SlipSearch& ranges) {
    return search(model, ranges).critical.value().bishop.factor_of_safety;
}

void expect_no_worse_shallower(const char* name, const scene::Scene& scene) {
    const Model model = make_model(scene);
    scene::SlipSearch ranges = *scene.lem->search;
    double narrower = std::numeric_limits<double>::infinity();
    for (const double depth : {5.0, 3.0, 2.0, 1.0, 0.7, 0.5, 0.25, 0.1, 0.0}) {
        ranges.minimum_depth = depth;
        const double F = least_factor(model, ranges);
        EXPECT_LE(F, narrower * (1.0 + allowed)) << name << ", minimum depth " << depth;
        narrower = std::min(narrower, F);
    }
}

/// Ranges that shrink to the ends of the widest search's critical surface.
void expect_no_worse_wider(const char* name, const scene::Scene& scene) {
    const Model model = make_model(scene);
    const scene::SlipSearch widest = *scene.lem->search;
    const Surface found = search(model, widest).critical.value().surface;
    const bool to_left = widest.entry[0] > widest.exit[0];
    const double entry = to_left ? found.right : found.left;
    const double exit = to_left ? found.left : found.right;
    double narrower = std::numeric_limits<double>::infinity();
    for (const double share : {0.05, 0.2, 0.5, 0.75, 1.0}) {
        scene::SlipSearch ranges = widest;
        for (int k = 0; k < 2; ++k) {
            ranges.entry[k] = entry + share * (widest.entry[k] - entry);
            ranges.exit[k] = exit + share * (widest.exit[k] - exit);
        }
        const double F = least_factor(model, ranges);
        EXPECT_LE(F, narrower * (1.0 + allowed)) << name << ", share " << share;
        narrower = std::min(narrower, F);
    }
}

/// A long slope of 20 degrees without cohesion: its critical surface has the least depth.
json long_slope(double c_kPa, double inclination) {
    const double rise = 60.0 * std::tan(inclination);
    json text = small::scene(
        {{"sand", small::soil(20, c_kPa, 30)}},
        json::array({small::region(
            "sand", "sand", {{0, -10}, {100, -10}, {100, rise}, {80, rise}, {20, 0}, {0, 0}})}),
        {{"search", {{"entry", {40, 90}}, {"exit", {5, 45}}}}});
    return text;
}

TEST(WiderSearch, OfLessDepthIsNoWorse) {
    expect_no_worse_shallower("two layers", small::parsed(small::two_layers(small::some_search())));
    expect_no_worse_shallower("without cohesion", small::parsed(long_slope(0.0, M_PI / 9.0)));
    expect_no_worse_shallower("steep, hardly any cohesion", small::parsed(long_slope(0.5, 0.5)));
    expect_no_worse_shallower(
        "slope.json", limit_scene(scene::read_scene(BREACH_ROOT "/workflows/scenes/slope.json")));
    expect_no_worse_shallower(
        "mochikoshi.json",
        limit_scene(scene::read_scene(BREACH_ROOT "/workflows/scenes/mochikoshi.json")));
}

TEST(WiderSearch, OfMoreGroundIsNoWorse) {
    expect_no_worse_wider("two layers", small::parsed(small::two_layers(small::some_search())));
    expect_no_worse_wider("steep, hardly any cohesion", small::parsed(long_slope(0.5, 0.5)));
    expect_no_worse_wider(
        "slope.json", limit_scene(scene::read_scene(BREACH_ROOT "/workflows/scenes/slope.json")));
    expect_no_worse_wider(
        "mochikoshi.json",
        limit_scene(scene::read_scene(BREACH_ROOT "/workflows/scenes/mochikoshi.json")));
}

TEST(Search, OfSoilWithoutCohesionEndsAtTheLeastDepth) {
    // the infinite slope of that depth: tan phi / tan beta is the limit for a vanishing one
    const scene::Scene scene = small::parsed(long_slope(0.0, M_PI / 9.0));
    const Model model = make_model(scene);
    scene::SlipSearch ranges = *scene.lem->search;
    ranges.minimum_depth = 0.5;
    const Critical found = search(model, ranges).critical.value();
    Slices slices = make_slices(model.strata, model.slices);
    cut(model.strata, model.soils, found.surface, model.slices, slices);
    EXPECT_NEAR(slices.depth, 0.5, 1e-4);
    EXPECT_NEAR(found.bishop.factor_of_safety, std::tan(M_PI / 6.0) / std::tan(M_PI / 9.0), 2e-3);
}

}  // namespace
}  // namespace breach::lem
