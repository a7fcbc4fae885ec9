#include <gtest/gtest.h>

#include <cmath>

#include "lem_tool/search.hpp"
#include "lem_tool/slip_circle.hpp"
#include "tests/verification/lem/case_scene.hpp"

namespace breach::lem::closed_form_test {
namespace {

using cases::json;

double factor_of(const json& scene_json, int slices) {
    json text = scene_json;
    text["lem"]["slices"] = slices;
    const scene::Scene scene = scene::parse_scene(text.dump(), "closed form");
    const Model model = make_model(scene);
    Slices cut_up = make_slices(model.strata, model.slices);
    const auto masses = masses_of(model.strata, *scene.lem->circle);
    EXPECT_EQ(masses.size(), 1u);
    EXPECT_EQ(cut(model.strata, model.soils, masses[0], model.slices, cut_up), Cut::done);
    return bishop(cut_up, slide_of(cut_up), 0.0).factor_of_safety;
}

TEST(FrictionlessCircle, HasFelleniusFactorWithFewSlices) {
    // Vertical cut of height H = 8 in clay, circle through its toe and centred above it: the mass
    // is a circular sector minus a triangle. F = c R^2 theta / (W x_W), in closed form.
    const double R = 20.0;
    const double H = 8.0;
    const double theta =
        std::asin((R - H) / R);             // angle of the centre's horizontal ray above the crest
    const double swept = M_PI / 2 - theta;  // from straight down to the crest's end of the arc
    const double reach = R * std::cos(theta);
    // Moment about the centre of the area between arc and crest level, x from 0 to reach: integral
    // of x (sqrt(R^2 - x^2) - (R - H)) dx.
    const double moment = (std::pow(R, 3) - std::pow(R * R - reach * reach, 1.5)) / 3.0 -
                          (R - H) * reach * reach / 2.0;
    const double c = 30.0;
    const double gamma = 19.0;
    const double expected = c * R * R * swept / (gamma * moment);
    const json scene{
        {"format", "breachline-scene/1"},
        {"name", "cut"},
        {"gravity", 10.0},
        {"materials",
         {{"clay",
           {{"density", 1900},
            {"law",
             {{"type", "mohr_coulomb"},
              {"E_MPa", 10},
              {"nu", 0.3},
              {"c_kPa", c},
              {"phi_deg", 0}}}}}}},
        {"section",
         {{"regions",
           {{{"name", "clay"},
             {"material", "clay"},
             {"polygon", {{-30, -5}, {40, -5}, {40, 8}, {0, 8}, {0, 0}, {-30, 0}, {-30, -5}}}}}}}},
        {"lem", {{"circle", {{"center", {0, R}}, {"radius", R}}}}}};
    // Length and weight are of fourth order in a slice's angle: 1/81 of the error with 3 times the
    // slices.
    for (const auto& [slices, allowed] : {std::pair{3, 5e-4}, {10, 5e-6}, {30, 5e-8}}) {
        const double F = factor_of(scene, slices);
        std::printf("%d slices: F %.10f, closed form %.10f, error %.1e, allowed %.1e\n", slices, F,
                    expected, F / expected - 1.0, allowed);
        EXPECT_NEAR(F / expected, 1.0, allowed);
    }
}

TEST(BishopFactor, ConvergesWithTheNumberOfSlices) {
    const json scene = cases::load("fk1_case1");
    const double exact = factor_of(scene, 5000);
    double previous = 1.0;
    for (const int slices : {10, 20, 40, 80}) {
        const double error = std::abs(factor_of(scene, slices) / exact - 1.0);
        std::printf("%d slices: error %.2e\n", slices, error);
        EXPECT_LT(error,
                  0.5 * previous);  // second order: a quarter each time, if the cuts fell alike
        previous = error;
    }
    EXPECT_LT(previous, 1e-4);
}

TEST(BishopFactor, SatisfiesItsOwnEquation) {
    const scene::Scene scene = cases::scene_of("acads_1c_circle");
    const Model model = make_model(scene);
    Slices s = make_slices(model.strata, model.slices);
    cut(model.strata, model.soils, masses_of(model.strata, *scene.lem->circle)[0], model.slices, s);
    const Bishop result = bishop(s, slide_of(s), 0.0);
    double resisting = 0.0;
    double driving = 0.0;
    for (std::size_t i = 0; i < s.count; ++i) {
        const double m = s.cos_a[i] + s.sin_a[i] * s.tan_phi[i] / result.factor_of_safety;
        resisting += (s.c[i] * s.length[i] * s.cos_a[i] + s.weight[i] * s.tan_phi[i]) / m;
        driving += s.driving[i];
    }
    EXPECT_NEAR(resisting / driving, result.factor_of_safety, 1e-9);
    EXPECT_LE(result.iterations, 6);
}

}  // namespace
}  // namespace breach::lem::closed_form_test
