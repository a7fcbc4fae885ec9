// Water, shaking and surcharge against problems with a known equivalent.
#include <gtest/gtest.h>

#include <cmath>

#include "lem_tool/search.hpp"
#include "lem_tool/slip_circle.hpp"
#include "tests/verification/lem/case_scene.hpp"

namespace breach::lem::loads_test {
namespace {

using cases::json;

double factor_of(const json& text) {
    const scene::Scene scene = scene::parse_scene(text.dump(), "loads");
    const Model model = make_model(scene);
    Slices slices = make_slices(model.strata, model.slices);
    const auto masses = masses_of(model.strata, *scene.lem->circle);
    EXPECT_EQ(masses.size(), 1u);
    EXPECT_EQ(cut(model.strata, model.soils, masses.at(0), model.slices, slices), Cut::done);
    return bishop(slices, slide_of(slices), model.k_h).factor_of_safety;
}

json fredlund_krahn() { return cases::load("fk1_case1"); }

TEST(Submergence, DeepWaterIsBuoyantWeightAtAnyDepth) {
    const double shallow = factor_of(cases::load("submerged_75"));
    json deeper = cases::load("submerged_75");
    for (json& vertex : deeper["lem"]["water"]["line"]) vertex[1] = 400.0;
    const double buoyant = factor_of(cases::load("buoyant"));
    std::printf("75 ft %.5f, 400 ft %.5f, buoyant weight without water %.5f\n", shallow,
                factor_of(deeper), buoyant);
    // In Bishop's vertical equilibrium the water's thrust acts slice by slice: equal up to the
    // slices' 1e-4 ...
    EXPECT_NEAR(shallow / buoyant, 1.0, 5e-4);
    // ... multiplied by the pressure of five times the water.
    EXPECT_NEAR(factor_of(deeper) / buoyant, 1.0, 5e-3);
}

TEST(PorePressureRatio, OfTheWholeMassIsAWeakerFriction) {
    // c = 0: (W - u l cos a) tan phi = W (1 - r_u) tan phi in the numerator; m_alpha keeps tan phi,
    // so F of the wet slope is between the two simple scalings; r_u = 1 leaves no strength.
    json wet = fredlund_krahn();
    wet["materials"]["soil"]["law"]["c_kPa"] = 0.0;
    const double dry = factor_of(wet);
    wet["lem"]["pore_pressure_ratios"] = json::array({{{"region", "soil"}, {"r_u", 0.25}}});
    const double F = factor_of(wet);
    std::printf("dry %.4f, r_u 0.25 %.4f, 0.75 of dry %.4f\n", dry, F, 0.75 * dry);
    EXPECT_LT(F, 0.75 * dry * 1.05);
    EXPECT_GT(F, 0.75 * dry * 0.9);
    wet["lem"]["pore_pressure_ratios"][0]["r_u"] = 1.0;
    // Only the segments between arc and chords keep a little: fourth order in the slice's angle.
    EXPECT_NEAR(factor_of(wet), 0.0, 1e-3);
}

TEST(PorePressureRatio, GivesFredlundAndKrahnsCaseThree) {
    // Fredlund & Krahn (1977), case 3: case 1 with r_u = 0.25; simplified Bishop 1.766 (from memory
    // of the paper's table; its r_u case is quoted by many manuals). 0.5 % as for case 1.
    json wet = fredlund_krahn();
    wet["lem"]["pore_pressure_ratios"] = json::array({{{"region", "soil"}, {"r_u", 0.25}}});
    const double F = factor_of(wet);
    std::printf("published 1.766, computed %.4f, difference %+.2f %%\n", F, 100 * (F / 1.766 - 1));
    EXPECT_NEAR(F / 1.766, 1.0, 5e-3);
}

TEST(Shaking, LowersTheFactorByItsMoment) {
    // phi = 0: F = resisting / (driving + k_h shaking), so 1 / F is linear in k_h
    json clay = fredlund_krahn();
    clay["materials"]["soil"]["law"]["phi_deg"] = 0.0;
    const auto inverse = [&](double k_h) {
        clay["lem"]["seismic_coefficient"] = k_h;
        return 1.0 / factor_of(clay);
    };
    const double at_rest = inverse(0.0);
    const double slope = (inverse(0.1) - at_rest) / 0.1;
    EXPECT_GT(slope, 0.0);
    EXPECT_NEAR(inverse(0.3), at_rest + 0.3 * slope, 1e-9);
}

TEST(Surcharge, DrivesBehindTheCentreAndHoldsBeforeIt) {
    // A surcharge behind the centre's vertical drives, one in front resists: the moments are exact.
    json clay = fredlund_krahn();
    clay["materials"]["soil"]["law"]["phi_deg"] = 0.0;
    const double plain = 1.0 / factor_of(clay);
    const auto inverse = [&](double from, double to) {
        clay["lem"]["surcharge"] =
            json::array({{{"from", from}, {"to", to}, {"pressure_kPa", 50.0}}});
        return 1.0 / factor_of(clay);
    };
    // The slope faces right: loads left of the centre (x = 120) drive; two strips with equal and
    // opposite moments.
    const double both = inverse(110, 130);
    EXPECT_NEAR(both, plain, 1e-7);  // the load's ends cut other slices: fourth order
    EXPECT_GT(inverse(60, 80), plain);
    EXPECT_LT(inverse(125, 135), plain);
}

}  // namespace
}  // namespace breach::lem::loads_test
