// Floors, cracks and water on vertical faces: phi = 0 masses with moments in closed form.
#include <gtest/gtest.h>

#include <cmath>

#include "lem_tool/facts.hpp"
#include "tests/unit/lem/small_scenes.hpp"

namespace breach::lem::composite_and_crack_test {
namespace {

using small::json;

constexpr double H = 8.0;       // height of the cut [m]
constexpr double R = 20.0;      // [m]
constexpr double c = 30e3;      // [Pa]
constexpr double gamma = 20e3;  // [N/m3]
constexpr double gamma_w = 10e3;

/// A vertical cut at x = 0, foot at y = 0, in clay; the circle is centred above the foot.
json cut_scene(double center_level, json lem) {
    lem["circle"] = {{"center", {0, center_level}}, {"radius", R}};
    return small::scene(
        {{"clay", small::soil(gamma / 1e3, c / 1e3, 0)}},
        json::array({small::region("clay", "clay",
                                   {{-40, -20}, {40, -20}, {40, H}, {0, H}, {0, 0}, {-40, 0}})}),
        lem);
}

json facts(const json& text) {
    const scene::Scene scene = small::parsed(text);
    const Model model = make_model(scene);
    Slices slices = make_slices(model.strata, model.slices);
    return facts_of(model, analyse_circle(scene, model, slices), slices);
}

double F_of(const json& text) { return facts(text).at("factor_of_safety"); }

/// Moment about the centre of the soil between arc and crest from x = a to b (a, b >= 0).
double moment_between(double center_level, double a, double b) {
    const auto third = [](double x) { return std::pow(R * R - x * x, 1.5) / 3.0; };
    return gamma * ((H - center_level) * (b * b - a * a) / 2.0 + third(a) - third(b));
}

double angle(double x) { return std::asin(x / R); }

void compare(const char* what, double F, double expected, double allowed) {
    std::printf("%s: F %.7f, closed form %.7f, error %.1e, allowed %.0e\n", what, F, expected,
                F / expected - 1.0, allowed);
    EXPECT_NEAR(F / expected, 1.0, allowed);
}

TEST(CompositeSurface, AlongALevelFloorHasTheFactorOfItsIntegral) {
    // Centre 2 m lower than the toe circle's: the arc reaches -2, and the floor y = 0 cuts it.
    const double level = R - 2.0;
    const double from = std::sqrt(R * R - level * level);
    const double to = std::sqrt(R * R - (level - H) * (level - H));
    const json text = cut_scene(level, {{"floor", {{0, 0}}}});
    // sum W h tan a = sum S h / cos a: the floor adds c * length * level
    const double expected = (c * R * R * (angle(to) - angle(from)) + c * from * level) /
                            moment_between(level, from, to);
    compare("floor", F_of(text), expected, 1e-6);
    EXPECT_NEAR(facts(text).at("lowest_point")[1].get<double>(), 0.0, 1e-9);
    EXPECT_NEAR(facts(text).at("sliding_depth").get<double>(), H, 1e-9);
}

TEST(CompositeSurface, FloorBelowTheCircleChangesNothing) {
    json text = cut_scene(R, json::object());
    const double plain = F_of(text);
    text["lem"]["floor"] = {{-50, -3}, {3, -7}, {50, -6}};
    EXPECT_NEAR(F_of(text), plain, 1e-6 * plain);  // its kink cuts one slice in two
}

TEST(CompositeSurface, SearchOverAFloorStaysOnIt) {
    json text = small::two_layers(small::some_search());
    text["lem"]["floor"] = {{0, -1}};
    const scene::Scene scene = small::parsed(text);
    const Model model = make_model(scene);
    Slices slices = make_slices(model.strata, model.slices);
    const json found = facts_of(model, *search(model, *scene.lem->search, 1).critical, slices);
    EXPECT_GE(found.at("lowest_point")[1], -1.0 - 1e-6);
}

TEST(TensionCrack, ShortensTheArcAndItsWaterPushes) {
    const double depth = 3.0;
    const double foot = H - depth;
    const double to = std::sqrt(R * R - (R - foot) * (R - foot));
    const double resisting = c * R * R * angle(to);
    const double driving = moment_between(R, 0.0, to);
    for (const double filled : {0.0, 0.5, 1.0}) {
        const double wet = filled * depth;
        const double push = 0.5 * gamma_w * wet * wet * (R - foot - wet / 3.0);
        const json text = cut_scene(R, {{"tension_crack", {{"depth", depth}, {"filled", filled}}}});
        compare("crack", F_of(text), resisting / (driving + push), 1e-6);
        EXPECT_NEAR(facts(text).at("entry")[1].get<double>(), foot, 1e-9);
    }
}

TEST(TensionCrack, DeeperThanTheMassLeavesNoSurface) {
    const json text = cut_scene(R, {{"tension_crack", {{"depth", 30.0}}}});
    EXPECT_THROW(F_of(text), fault::BadInput);
}

TEST(FreeWater, AgainstTheFaceAtTheToeHoldsIt) {
    const double h = 5.0;
    const double to = std::sqrt(R * R - (R - H) * (R - H));
    const json text = cut_scene(R, {{"water", {{"line", {{0, h}}}}}});
    // Water in the soil has no moment about the centre except its pressure on the arc, which does
    // not matter with phi = 0; its weight is in gamma.
    const double thrust = 0.5 * gamma_w * h * h * (R - h / 3.0);
    compare("face at the toe", F_of(text),
            c * R * R * angle(to) / (moment_between(R, 0.0, to) - thrust), 1e-6);
}

TEST(FreeWater, AgainstAFaceInsideTheMassHoldsItToo) {
    // Lower centre: the arc passes below the foot and exits in front of the face.
    const double level = R - 2.0;
    const double h = 5.0;
    const double front = std::sqrt(R * R - level * level);
    const json dry = cut_scene(level, json::object());
    const json wet = cut_scene(level, {{"water", {{"line", {{0, h}}}}}});
    const double back = std::sqrt(R * R - (level - H) * (level - H));
    const double resisting = c * R * R * (angle(back) + angle(front));
    const auto third = [](double x) { return std::pow(R * R - x * x, 1.5) / 3.0; };
    // Soil in front of the face, ground at 0: the integral of x (arc depth below 0) is negative.
    const double before = -gamma * (-level * front * front / 2.0 + third(0.0) - third(front));
    const double driving = moment_between(level, 0.0, back) + before;
    compare("dry", F_of(dry), resisting / driving, 1e-6);
    const double water = gamma_w * h * front * front / 2.0 +         // on the bed
                         0.5 * gamma_w * h * h * (level - h / 3.0);  // against the face
    compare("wet", F_of(wet), resisting / (driving - water), 1e-6);
}

TEST(Methods, AgreeWithoutFrictionOnACircle) {
    // The resultant's moment is unique: every method in moment equilibrium gives the same F.
    json text = small::two_layers(small::some_circle());
    text["materials"]["fill"] = small::soil(20, 25, 0);
    text["materials"]["base"] = small::soil(18, 40, 0);
    const json all = facts(text);
    const double F = all.at("factor_of_safety");
    EXPECT_NEAR(all.at("ordinary").at("factor_of_safety").get<double>() / F, 1.0, 1e-9);
    ASSERT_FALSE(all.at("spencer").is_null());
    EXPECT_NEAR(all.at("spencer").at("factor_of_safety").get<double>() / F, 1.0, 1e-6);
}

/// A homogeneous bank of clay, 10 m high, on a circle, all in units of s_u = 50 kPa and 20 kN/m3.
json bank(double run, double x, double y, double radius, json lem) {
    lem["circle"] = {{"center", {x, y}}, {"radius", radius}};
    return small::scene(
        {{"clay", small::soil(20, 50, 0)}},
        json::array({small::region(
            "clay", "clay", {{0, -30}, {130, -30}, {130, 10}, {60 + run, 10}, {60, 0}, {0, 0}})}),
        lem);
}

TEST(Methods, SpencerSaysWhyItHasNoAnswer) {
    // Force equilibrium alone gives F = sum(c l / cos(a - t)) / sum(W sin a / cos(a - t)), which
    // for this circle is at least 1.6857 (t = 0.2 rad), while moment equilibrium gives 1.6700;
    // computed independently.
    const json all = facts(bank(5, 59.425, 34.712, 33.9175, json::object()));
    EXPECT_NEAR(all.at("factor_of_safety").get<double>(), 1.6700, 1e-3);
    EXPECT_TRUE(all.at("spencer").is_null());
    const std::string why = all.at("spencer_reason");
    EXPECT_NE(why.find("forces in balance at F = 1.686"), std::string::npos) << why;
    EXPECT_NE(why.find("without friction the moments alone give"), std::string::npos) << why;
}

TEST(Methods, SpencerHasTheMomentsFactorOrAReasonWithoutFriction) {
    int answered = 0;
    for (const double run : {5.0, 20.0}) {
        for (const double x : {58.0, 63.0, 68.0}) {
            for (const double y : {12.0, 20.0, 32.0}) {
                for (const double bottom : {-25.0, -8.0, -1.0}) {
                    const json all = facts(bank(run, x, y, y - bottom, json::object()));
                    if (all.at("spencer").is_null()) {
                        EXPECT_NE(all.at("spencer_reason"), "");
                        continue;
                    }
                    ++answered;
                    EXPECT_EQ(all.at("spencer_reason"), "");
                    const double F = all.at("factor_of_safety");
                    const double S = all.at("spencer").at("factor_of_safety");
                    EXPECT_NEAR(S / F, 1.0, 1e-6) << x << " " << y << " " << bottom;
                }
            }
        }
    }
    EXPECT_GE(answered, 40);
}

TEST(Methods, AgreeOnALongSlope) {
    // Shallow arc, c = 0: the infinite slope, tan(phi) / tan(beta) for all methods.
    const double slope = 0.5;
    const json text = small::scene(
        {{"sand", small::soil(20, 0, 35)}},
        json::array({small::region("sand", "sand", {{0, -30}, {200, -30}, {200, 100}, {0, 0}})}),
        {{"circle", {{"center", {100 - 2000 * 0.5, 50 + 2000}}, {"radius", 2237.07}}}});
    const json all = facts(text);
    const double expected = std::tan(35.0 * M_PI / 180.0) / slope;
    for (const double F : {all.at("factor_of_safety").get<double>(),
                           all.at("ordinary").at("factor_of_safety").get<double>(),
                           all.at("spencer").at("factor_of_safety").get<double>()}) {
        compare("long slope", F, expected, 2e-3);  // the arc still turns by 3 degrees
    }
}

TEST(CosSquared, IsSeepageParallelToALongSlope) {
    const double slope = 0.5;
    const double expected = (1.0 - 10.0 / 20.0) * std::tan(35.0 * M_PI / 180.0) / slope;
    json text = small::scene(
        {{"sand", small::soil(20, 0, 35)}},
        json::array({small::region("sand", "sand", {{0, -30}, {200, -30}, {200, 100}, {0, 0}})}),
        {{"circle", {{"center", {100 - 2000 * 0.5, 50 + 2000}}, {"radius", 2237.07}}},
         {"water", {{"line", {{0, -1e-6}, {200, 100 - 1e-6}}}, {"correction", "cos2"}}}});
    // Bishop's horizontal interslice forces cannot carry the water pressure along the slope;
    // Spencer's, parallel to it, can.
    compare("cos2, Spencer", facts(text).at("spencer").at("factor_of_safety"), expected, 5e-3);
    const double corrected = F_of(text);
    text["lem"]["water"]["correction"] = "none";
    EXPECT_LT(F_of(text), corrected);
}

TEST(UndrainedStrength, FollowsTheVerticalEffectiveStress) {
    json text = small::two_layers(small::some_circle());
    text["lem"]["water"] = {{"line", {{0, 6}, {20, 6}, {40, -1}, {60, -1}}}};
    text["lem"]["undrained"] = {{{"region", "base"},
                                 {"strength_kPa", 2.0},
                                 {"coefficient_kPa", 6.609},
                                 {"exponent", 0.5763}}};
    const scene::Scene scene = small::parsed(text);
    const Model model = make_model(scene);
    Slices s = make_slices(model.strata, model.slices);
    (void)analyse_circle(scene, model, s);
    std::size_t weak = 0;
    for (std::size_t i = 0; i < s.count; ++i) {
        if (s.base[i] > 0.0) continue;
        ++weak;
        const double sigma_v0 = s.weight[i] / s.width[i] - s.u[i];
        EXPECT_NEAR(s.c[i], 2e3 + 6.609e3 * std::pow(sigma_v0 / 101325.0, 0.5763), 1e-6);
        EXPECT_EQ(s.tan_phi[i], 0.0);
    }
    EXPECT_GT(weak, 5u);
}

TEST(UndrainedStrength, IsAMaterialWithoutFriction) {
    json text = small::two_layers(small::some_circle());
    text["lem"]["undrained"] = {{{"region", "base"}, {"strength_kPa", 15}}};
    const double undrained = F_of(text);
    text["lem"].erase("undrained");
    text["materials"]["base"] = small::soil(18, 15, 0);
    EXPECT_EQ(F_of(text), undrained);
}

}  // namespace
}  // namespace breach::lem::composite_and_crack_test
