// Position of water and depth of a crack, against hand calculation and an equivalent slope.
#include <gtest/gtest.h>

#include <cmath>

#include "lem_tool/facts.hpp"
#include "tests/unit/lem/small_scenes.hpp"
#include "tests/verification/lem/case_scene.hpp"

namespace breach::lem::water_and_crack_test {
namespace {

using small::json;

json facts(const json& text, Slices& slices) {
    const scene::Scene scene = small::parsed(text);
    const Model model = make_model(scene);
    slices = make_slices(model.strata, model.slices);
    return facts_of(model, analyse_circle(scene, model, slices), slices);
}

double F_of(const json& text, const char* method = nullptr) {
    Slices slices;
    const json all = facts(text, slices);
    return (method == nullptr ? all : all.at(method)).at("factor_of_safety");
}

TEST(CosSquared, DoesNotAskARoundingWhetherALineOnTheGroundIsBelowIt) {
    // The seepage face of 29c follows a slope of 45 degrees: cos^2 = 0.5.
    const json text = cases::load("pyslope_c_r3");
    const double F = F_of(text);
    for (const double shift : {1e-12, -1e-12, 1e-9, -1e-9, 1e-6, -1e-6}) {
        json moved = text;
        for (json& point : moved["lem"]["water"]["line"]) point[1] = point[1].get<double>() + shift;
        EXPECT_NEAR(F_of(moved), F, 1e-5 + 10.0 * std::abs(shift)) << shift;
    }
    json uncorrected = text;
    uncorrected["lem"]["water"]["correction"] = "none";
    EXPECT_LT(F_of(uncorrected), 0.98 * F);
}

TEST(Ordinary, OfASlopeUnderWaterIsThatOfItsBuoyantWeight) {
    // Duncan & Wright's fig. 6.27 (cases 16a, 16c): water up to the crest at 45 ft, 30, 60 and
    // 355 ft above it
    const double buoyant = F_of(cases::load("buoyant"), "ordinary");
    json text = cases::load("submerged_75");
    for (const double level : {45.0, 75.0, 105.0, 400.0}) {
        for (json& point : text["lem"]["water"]["line"]) point[1] = level;
        Slices slices;
        const json all = facts(text, slices).at("ordinary");
        const double F = all.at("factor_of_safety");
        std::printf("water at %.0f ft: %.4f, conventional %.4f, buoyant weight %.4f\n", level, F,
                    all.at("conventional").get<double>(), buoyant);
        // u is that of the slice's middle: as with Bishop, the pressure of deep water magnifies the
        // slices' error.
        EXPECT_NEAR(F / buoyant, 1.0, level > 200.0 ? 5e-3 : 1e-3);
    }
}

TEST(Ordinary, OfADrySlopeHasOneFormOnly) {
    Slices slices;
    const json all = facts(small::two_layers(small::some_circle()), slices).at("ordinary");
    EXPECT_NEAR(all.at("factor_of_safety").get<double>(), all.at("conventional").get<double>(),
                1e-12);
}

json wet(const json& lem_part) {
    json text = small::two_layers(small::some_circle());
    text["lem"].update(lem_part);
    return text;
}

const json low_line = {{0, 6}, {20, 6}, {40, -1}, {60, -1}};   // below ground all over
const json high_line = {{0, 8}, {20, 8}, {40, -1}, {60, -1}};  // too

TEST(PiezometricLine, OfEveryRegionIsThePhreaticLine) {
    const double F = F_of(wet({{"water", {{"line", low_line}}}}));
    const double same =
        F_of(wet({{"piezometric_lines", {{{"line", low_line}, {"regions", {"fill", "base"}}}}}}));
    EXPECT_NEAR(same, F, 1e-12);
    EXPECT_LT(F, F_of(wet(json::object())));
}

/// u by hand: gamma_w = 10 kN/m3 times the depth below the polyline.
double u_below(const json& line, double x, double y) {
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const double x0 = line[i][0], x1 = line[i + 1][0];
        if (x < x0 || x > x1) continue;
        const double y0 = line[i][1], y1 = line[i + 1][1];
        return std::max(0.0, 10e3 * (y0 + (y1 - y0) * (x - x0) / (x1 - x0) - y));
    }
    return 0.0;
}

void expect_pressures(const char* what, const json& lem, const json& fill_line,
                      const json& base_line) {
    Slices s;
    (void)facts(wet(lem), s);
    std::size_t wet_slices = 0;
    for (std::size_t i = 0; i < s.count; ++i) {
        const json& line = s.base[i] > 0.0 ? fill_line : base_line;
        const double u = u_below(line, s.left[i] + 0.5 * s.width[i], s.base[i]);
        EXPECT_NEAR(s.u[i], u, 1e-6) << what << ", x = " << s.left[i];
        wet_slices += u > 0.0 ? 1 : 0;
    }
    EXPECT_GT(wet_slices, 3u) << what;
}

TEST(PorePressure, IsThatOfTheRegionsOwnLine) {
    const json dry = json::array();
    expect_pressures("water in the base only",
                     {{"water", {{"line", low_line}, {"regions", {"base"}}}}}, dry, low_line);
    expect_pressures("a line for the fill only",
                     {{"piezometric_lines", {{{"line", high_line}, {"regions", {"fill"}}}}}},
                     high_line, dry);
    expect_pressures("water, but for the fill its own line",
                     {{"water", {{"line", low_line}, {"regions", {"base"}}}},
                      {"piezometric_lines", {{{"line", high_line}, {"regions", {"fill"}}}}}},
                     high_line, low_line);
    expect_pressures("water where no line is named",
                     {{"water", {{"line", low_line}}},
                      {"piezometric_lines", {{{"line", high_line}, {"regions", {"fill"}}}}}},
                     high_line, low_line);
}

TEST(PorePressure, OfADryRegionIsItsRatio) {
    Slices s;
    (void)facts(wet({{"water", {{"line", low_line}, {"regions", {"base"}}}},
                     {"pore_pressure_ratios", {{{"region", "fill"}, {"r_u", 0.25}}}}}),
                s);
    for (std::size_t i = 0; i < s.count; ++i) {
        if (s.base[i] <= 0.0) continue;
        EXPECT_NEAR(s.u[i], 0.25 * s.soil_weight[i] / s.width[i], 1e-9);
    }
}

TEST(PorePressure, OfOneRegionLeavesFreeWaterOnTheOther) {
    // A lake over a blanket that its water does not enter: weight, but no pore pressure.
    const json lake = {{0, 12}, {60, 12}};
    Slices s;
    (void)facts(wet({{"water", {{"line", lake}, {"regions", {"base"}}}}}), s);
    Slices plain;
    (void)facts(wet(json::object()), plain);
    ASSERT_EQ(s.count, plain.count);
    for (std::size_t i = 0; i < s.count; ++i) {
        if (s.base[i] <= 0.0) continue;
        EXPECT_EQ(s.u[i], 0.0);
        EXPECT_GT(s.weight[i], plain.weight[i]);
    }
}

TEST(PhreaticLines, AreOnePerRegion) {
    const json twice = {{"water", {{"line", low_line}, {"regions", {"fill"}}}},
                        {"piezometric_lines", {{{"line", high_line}, {"regions", {"fill"}}}}}};
    EXPECT_THROW(small::parsed(wet(twice)), fault::BadInput);
    EXPECT_THROW(small::parsed(wet({{"water", {{"line", low_line}, {"regions", {"lake"}}}}})),
                 fault::BadInput);
}

// A vertical cut of height 8 in clay of 20 kN/m3, circle of 20 m centred above its foot, as in
// composite_and_crack_test.cpp; here with the crack's tip given by its level.
constexpr double H = 8.0, R = 20.0, c = 30e3, gamma = 20e3, gamma_w = 10e3;

json cut_scene(const json& crack) {
    return small::scene(
        {{"clay", small::soil(gamma / 1e3, c / 1e3, 0)}},
        json::array({small::region("clay", "clay",
                                   {{-40, -20}, {40, -20}, {40, H}, {0, H}, {0, 0}, {-40, 0}})}),
        {{"circle", {{"center", {0, R}}, {"radius", R}}}, {"tension_crack", crack}});
}

TEST(CrackToALevel, HasTheFactorOfItsIntegral) {
    const double foot = 5.0;
    const double to = std::sqrt(R * R - (R - foot) * (R - foot));
    const auto third = [](double x) { return std::pow(R * R - x * x, 1.5) / 3.0; };
    const double driving = gamma * ((H - R) * to * to / 2.0 + third(0.0) - third(to));
    for (const double filled : {0.0, 0.5, 1.0}) {
        const double water = filled * (H - foot);
        const double push = 0.5 * gamma_w * water * water * (R - foot - water / 3.0);
        const double expected = c * R * R * std::asin(to / R) / (driving + push);
        const double F = F_of(cut_scene({{"level", foot}, {"filled", filled}}));
        std::printf("filled %.1f: %.7f, closed form %.7f\n", filled, F, expected);
        EXPECT_NEAR(F / expected, 1.0, 1e-6);
    }
}

TEST(CrackToALevel, EndsThereBelowAnyGround) {
    json text = small::two_layers(small::some_circle());
    text["section"]["regions"][1] =
        small::region("fill", "fill", {{0, 0}, {40, 0}, {20, 10}, {0, 12}});  // a sloping crest
    text["lem"]["tension_crack"] = {{"level", 7.5}};
    Slices slices;
    const json all = facts(text, slices);
    EXPECT_NEAR(all.at("entry")[1].get<double>(), 7.5, 1e-9);
}

TEST(CrackToALevel, AboveTheGroundIsNone) {
    const json plain = small::two_layers(small::some_circle());
    json text = plain;
    text["lem"]["tension_crack"] = {{"level", 11.0}, {"filled", 1.0}};
    EXPECT_EQ(F_of(text), F_of(plain));
}

TEST(TensionCrack, IsSaidInOneWay) {
    EXPECT_THROW(small::parsed(cut_scene(json::object())), fault::BadInput);
    EXPECT_THROW(small::parsed(cut_scene({{"level", 5.0}, {"depth", 3.0}})), fault::BadInput);
}

}  // namespace
}  // namespace breach::lem::water_and_crack_test
