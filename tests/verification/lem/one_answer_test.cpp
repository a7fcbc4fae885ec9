// The result is the least valid factor of all surfaces; thin weak layers are found without request,
// and bounds that raise the factor are flagged.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "lem_tool/answer.hpp"
#include "lem_tool/limit_scene.hpp"
#include "lem_tool/optimise.hpp"
#include "lem_tool/stages.hpp"
#include "lem_tool/weak_layers.hpp"
#include "tests/unit/lem/small_scenes.hpp"

namespace breach::lem {
namespace {

using small::json;

struct Analysed {
    json answer;
    std::vector<fault::Flag> flags;

    double factor() const { return answer.at("factor_of_safety"); }
    double bishop() const { return answer.at("bishop").at("factor_of_safety"); }
    const fault::Flag* flag(const std::string& code, const std::string& pointer) const {
        for (const fault::Flag& each : flags)
            if (each.code == code && each.pointer == pointer) return &each;
        return nullptr;
    }
};

Analysed analysed(const scene::Scene& scene) {
    const Model model = make_model(scene);
    const Families families = search_families(scene, model, *scene.lem->search, 1);
    Analysed result{answer(scene, families), {}};
    add_flags_of_state(scene, {"", model, families, result.answer}, 1, result.flags);
    return result;
}

Analysed analysed(const json& text) { return analysed(small::parsed(text)); }

// Giam & Donald (1989), EX4: published answers 0.69 to 0.78, the referee's 0.78.
TEST(OneAnswer, OfAcads4IsTheLeastOfItsSurfaces) {
    scene::Scene scene =
        scene::read_scene(BREACH_ROOT "/workflows/verification/catalogue/lem/acads_4.json");
    for (const bool asked : {true, false}) {
        if (!asked) scene.lem->non_circular.reset();
        const Analysed found = analysed(scene);
        std::printf("ACADS 4, polyline %s: %.4f by %s on %s, circle %.4f\n",
                    asked ? "asked for" : "not asked for", found.factor(),
                    found.answer.at("method").get<std::string>().c_str(),
                    found.answer.at("surface").get<std::string>().c_str(), found.bishop());
        EXPECT_GT(found.factor(), 0.67);
        EXPECT_LT(found.factor(), 0.785);
        EXPECT_NEAR(found.bishop(), 1.086, 0.002) << "Bishop's stays Bishop's";
    }
}

/// 15 m of fill, 1 : 2, on a seam whose top passes through the fill's toe and dips downstream.
struct FillOnSeam {
    double thickness;
    json seam;
    json fill = small::soil(20, 5, 35);
    double dip = 0.0;  ///< [degrees]

    double top(double x) const { return -std::tan(dip * std::numbers::pi / 180.0) * (x - 80.0); }
    double bottom(double x) const { return top(x) - thickness; }
    json scene(const json& lem = json::object()) const {
        json all = {{"search", {{"entry", {5, 55}}, {"exit", {60, 120}}}}};
        all.update(lem);
        return small::scene(
            {{"fill", fill}, {"seam", seam}, {"base", small::soil(20, 20, 38)}},
            json::array(
                {small::region("fill", "fill", {{0, top(0)}, {80, 0}, {50, 15}, {0, 15}}),
                 small::region(
                     "seam", "seam",
                     {{0, bottom(0)}, {130, bottom(130)}, {130, top(130)}, {80, 0}, {0, top(0)}}),
                 small::region("base", "base",
                               {{0, -35}, {130, -35}, {130, bottom(130)}, {0, bottom(0)}})}),
            all);
    }
};

json fill_on_seam(double thickness, const json& seam, const json& lem = json::object()) {
    return FillOnSeam{thickness, seam}.scene(lem);
}

/// Least factor of Spencer's method for surfaces drawn by hand: down through the fill, along the
/// seam's bottom, and up through seam and fill.
double least_by_hand(const FillOnSeam& dam) {
    const scene::Scene scene = small::parsed(dam.scene());
    const Model model = make_model(scene);
    Slices slices = make_slices(model.strata, model.slices);
    const double slope = dam.top(1.0) - dam.top(0.0);
    const auto rises = [](double degrees) { return std::tan(degrees * std::numbers::pi / 180.0); };
    double least = std::numeric_limits<double>::infinity();
    for (double entry = 30.0; entry <= 56.0; entry += 2.0) {
        for (const double down : {40.0, 47.5, 55.0, 62.5, 70.0}) {
            for (double leaves = 70.0; leaves <= 94.0; leaves += 2.0) {
                for (const double up : {10.0, 20.0, 30.0}) {
                    const double head = end_level(model.strata, entry, SurfaceEnd::upper);
                    const double foot = entry + (head - dam.bottom(entry)) / (rises(down) + slope);
                    if (foot >= leaves) continue;
                    double exit = leaves;
                    while (exit < 129.0 && dam.bottom(leaves) + rises(up) * (exit - leaves) <
                                               end_level(model.strata, exit, SurfaceEnd::lower))
                        exit += 0.01;
                    const Polyline surface{
                        {{entry, head},
                         {foot, dam.bottom(foot)},
                         {leaves, dam.bottom(leaves)},
                         {exit, end_level(model.strata, exit, SurfaceEnd::lower)}}};
                    const auto found = analyse(model, surface, slices);
                    if (!found || found->spencer.m_alpha < least_m_alpha) continue;
                    least = std::min(least, found->spencer.factor_of_safety);
                }
            }
        }
    }
    return least;
}

constexpr std::array thicknesses{0.1, 0.3, 0.5, 1.0};

/// Factors of the search for these seam thicknesses: at most those drawn by hand, and decreasing
/// with the thickness.
std::array<double, 4> factors_by_thickness(FillOnSeam dam) {
    std::array<double, 4> factors{};
    double thinner = 10.0;
    std::size_t n = 0;
    for (const double thickness : thicknesses) {
        dam.thickness = thickness;
        const Analysed found = analysed(dam.scene());
        const double by_hand = least_by_hand(dam);
        std::printf("dip %.0f, seam of %.1f m: circle %.4f, by hand %.4f, answer %.4f\n", dam.dip,
                    thickness, found.bishop(), by_hand, found.factor());
        EXPECT_LE(found.factor(), 1.005 * by_hand);
        EXPECT_LT(found.factor(), 0.95 * found.bishop());
        EXPECT_LT(found.factor(), 1.03 * thinner);
        thinner = factors[n++] = found.factor();
    }
    return factors;
}

TEST(ThinWeakLayer, IsFollowedAsIfItsBottomWereGivenAsAFloor) {
    for (const double thickness : thicknesses) {
        const Analysed found = analysed(fill_on_seam(thickness, small::soil(20, 0, 8)));
        const Analysed given = analysed(fill_on_seam(
            thickness, small::soil(20, 0, 8), {{"floor", {{0, -thickness}, {130, -thickness}}}}));
        const double along = found.answer.at("composite").at("factor_of_safety");
        EXPECT_NEAR(along / given.bishop(), 1.0, 1e-6);
        EXPECT_NE(found.answer.at("surface"), "circle");
        EXPECT_EQ(found.answer.at("method"), "spencer");
        EXPECT_LT(found.factor(), along);
    }
}

// Reconstructed from numbers: a seam with 8 degrees of friction below 15 m of fill had 1.11, 1.095,
// 1.082 and 1.041 on composite surfaces, and circles 1.773, 1.608, 1.494 and 1.292.
TEST(ThinWeakLayer, OfEightDegreesHasTheFactorOfCompositeSurfacesAndLess) {
    FillOnSeam dam{0.1, small::soil(20, 0, 8), small::soil(20, 10, 35)};
    constexpr std::array composite{1.11, 1.095, 1.082, 1.041};
    const auto factors = factors_by_thickness(dam);
    for (std::size_t n = 0; n < factors.size(); ++n) {
        dam.thickness = thicknesses[n];
        const Analysed found = analysed(dam.scene());
        const double along = found.answer.at("composite").at("spencer").at("factor_of_safety");
        std::printf("seam of %.1f m: composite %.4f, handed in %.3f, answer %.4f\n", dam.thickness,
                    along, composite[n], factors[n]);
        EXPECT_NEAR(along / composite[n], 1.0, 0.01);
        EXPECT_LE(factors[n], along);
    }
}

TEST(ThinWeakLayer, ThatDipsIsFoundAsWellAsByHand) {
    for (const json& seam : {small::soil(20, 0, 8), small::soil(20, 2, 12), small::soil(18, 5, 10)})
        factors_by_thickness({0.1, seam, small::soil(20, 5, 35), 8.0});
}

TEST(ThinWeakLayer, OfClayWithoutFrictionHasAPolylineThatCounts) {
    const Analysed found =
        analysed(fill_on_seam(0.3, small::soil(20, 15, 0), {{"non_circular", {{"vertices", 9}}}}));
    const json& polyline = found.answer.at("non_circular");
    EXPECT_GT(polyline.at("frictionless_share"), 0.5);
    EXPECT_LT(polyline.at("frictionless_mass"), 0.1);
    EXPECT_LE(found.factor(), polyline.at("factor_of_safety"));
    EXPECT_EQ(found.flag("kinked_without_friction", "/lem/non_circular"), nullptr);
}

TEST(ThinWeakLayer, ThatLiquefiesDecidesTheCriticalDepth) {
    const scene::Scene scene = limit_scene(small::parsed(
        fill_on_seam(0.5, small::soil(20, 5, 35),
                     {{"water", {{"line", {{0, 0}, {130, 0}}}}},
                      {"liquefaction", {{{"region", "seam"}, {"residual_strength_kPa", 4}}}}})));
    const Model model = make_model(scene);
    const Families families = search_families(scene, model, *scene.lem->search, 1);
    EXPECT_TRUE(families.composites.empty()) << "the sound seam is like its neighbours";
    json result = answer(scene, families);
    std::vector<fault::Flag> flags;
    add_stages(scene, model, families, 1, result, flags);
    const json& last = result.at("stages").back();
    std::printf("liquefied seam: circle %.4f, answer %.4f\n",
                last.at("bishop").at("factor_of_safety").get<double>(),
                last.at("factor_of_safety").get<double>());
    EXPECT_NE(last.at("surface"), "circle");
    EXPECT_LT(last.at("factor_of_safety"), 1.0);
    EXPECT_GT(last.at("bishop").at("factor_of_safety"), 1.0) << "circles are blind to it";
    EXPECT_NEAR(result.at("critical_depth"), 0.5, 1e-6);
    EXPECT_FALSE(result.at("depth_at_fs_1").is_null());
}

/// The unrequested search costs scenes without thin weak layers nothing.
TEST(ThinWeakLayer, IsInNoneOfTheShippedScenes) {
    for (const char* name : {"slope", "flow_slope", "mochikoshi", "merriespruit"}) {
        const scene::Scene scene = limit_scene(
            scene::read_scene(std::string(BREACH_ROOT "/workflows/scenes/") + name + ".json"));
        Model model = make_model(scene);
        const Model sound = model;
        for (std::size_t n = 0; n <= scene.lem->liquefaction.size(); ++n) {
            model.soils = liquefied(sound, scene.lem->liquefaction, n);
            EXPECT_TRUE(weak_lines(model, *scene.lem->search).empty()) << name << " " << n;
        }
    }
}

/// A bank of 15 m, 1 : 2, on a layer of 2 m that is weaker than the soil above and below it.
TEST(WeakLayer, TooThickForACompositeSurfaceIsQuestionedByAPolyline) {
    json scene = small::scene(
        {{"fill", small::soil(19, 5, 35)}, {"seam", small::soil(18, 0, 10)}},
        json::array({small::region("fill", "fill", {{0, 0}, {50, 0}, {20, 15}, {0, 15}}),
                     small::region("seam", "seam", {{0, -2}, {90, -2}, {90, 0}, {0, 0}}),
                     small::region("base", "fill", {{0, -12}, {90, -12}, {90, -2}, {0, -2}})}),
        {{"search", {{"entry", {2, 25}}, {"exit", {45, 85}}}}});
    const Analysed circle = analysed(scene);
    const fault::Flag* flag = circle.flag("surfaces_disagree", "/lem/non_circular");
    ASSERT_NE(flag, nullptr);
    EXPECT_EQ(flag->severity, fault::Severity::questionable);
    scene["lem"]["non_circular"] = {{"vertices", 13}};
    const Analysed asked = analysed(scene);
    EXPECT_EQ(asked.flag("surfaces_disagree", "/lem/non_circular"), nullptr);
    EXPECT_LT(asked.answer.at("factor_of_safety"),
              0.97 * circle.answer.at("factor_of_safety").get<double>());
}

/// 10 m high, 1 : 1.5, c 5 kPa, phi 30: 1.309 without a crack; tension zone 0.93 m.
json cracked(const json& crack) {
    json text = small::scene(
        {{"s", small::soil(18.64, 5, 30)}},
        json::array(
            {small::region("s", "s", {{0, 0}, {60, 0}, {60, 5}, {35, 5}, {20, 15}, {0, 15}})}),
        {{"search", {{"entry", {2, 19.5}}, {"exit", {30, 55}}}}});
    if (!crack.is_null()) text["lem"]["tension_crack"] = crack;
    return text;
}

TEST(TensionCrack, NeverMakesASlopeSafer) {
    const Analysed none = analysed(cracked(nullptr));
    EXPECT_NEAR(none.bishop(), 1.309, 0.001);
    for (const double filled : {0.0, 1.0}) {
        for (const double depth : {4.0, 9.0}) {
            const Analysed found = analysed(cracked({{"depth", depth}, {"filled", filled}}));
            const json& crack = found.answer.at("bishop").at("tension_crack");
            std::printf("crack of %.0f m, filled %.0f: %.4f, %s at the whole depth\n", depth,
                        filled, found.bishop(), crack.at("factor_of_safety_whole").dump().c_str());
            EXPECT_LE(found.bishop(), none.bishop());
            EXPECT_GE(crack.at("factor_of_safety_whole"), found.bishop());
            EXPECT_NEAR(crack.at("tension_zone"), 10.0 / 18.64 * std::sqrt(3.0), 0.01);
            const fault::Flag* flag = found.flag("deep_crack", "/lem/tension_crack");
            const bool is_raised = crack.at("factor_of_safety_whole") > 1.01 * found.bishop();
            ASSERT_EQ(flag != nullptr, is_raised);
            if (!is_raised) continue;
            EXPECT_NE(flag->message.find("open to 0.92"), std::string::npos) << flag->message;
            const std::string remedy = flag->message.substr(flag->message.find("/depth=") + 7);
            const Analysed mended =
                analysed(cracked({{"depth", std::stod(remedy)}, {"filled", filled}}));
            EXPECT_EQ(mended.flag("deep_crack", "/lem/tension_crack"), nullptr) << remedy;
            EXPECT_NEAR(mended.bishop(), found.bishop(), 0.01);
        }
    }
}

/// A bank of 10 m, 1 : 2, on 15 m of weaker soil.
json bank(const json& lem) {
    return small::scene(
        {{"upper", small::soil(20, 10, 30)}, {"lower", small::soil(18, 12, 10)}},
        json::array(
            {small::region("upper", "upper", {{0, 0}, {60, 0}, {40, 10}, {0, 10}}),
             small::region("lower", "lower", {{0, -15}, {90, -15}, {90, 0}, {60, 0}, {0, 0}})}),
        lem);
}

TEST(Bound, ThatRaisesTheFactorIsFlaggedWithBothNumbers) {
    const json ranges = {{"entry", {2, 39}}, {"exit", {45, 85}}};
    const auto with = [&](const char* key, const json& value) {
        json search = ranges;
        search[key] = value;
        return bank({{"search", search}});
    };
    const Analysed free = analysed(bank({{"search", ranges}}));
    json floored = bank({{"search", ranges}, {"floor", {{0, 0}}}});
    json narrow = bank({{"search", {{"entry", {30, 38}}, {"exit", {45, 60}}}}});
    const std::vector<std::pair<json, std::string>> bounds{
        {floored, "/lem/floor"},
        {with("lowest_level", 0.0), "/lem/search/lowest_level"},
        {narrow, "/lem/search/entry"}};
    char number[16];
    std::snprintf(number, sizeof number, "%.3f", free.bishop());
    for (const auto& [text, pointer] : bounds) {
        const Analysed found = analysed(text);
        EXPECT_GT(found.bishop(), 1.01 * free.bishop()) << pointer;
        const fault::Flag* flag = found.flag("bound_raises_factor", pointer);
        ASSERT_NE(flag, nullptr) << pointer;
        std::printf("%s: %s\n", pointer.c_str(), flag->message.c_str());
        EXPECT_NE(flag->message.find(number), std::string::npos) << flag->message << number;
        EXPECT_EQ(flag->severity, free.bishop() < 1.0 && found.bishop() >= 1.0
                                      ? fault::Severity::questionable
                                      : fault::Severity::warning);
    }
}

TEST(Bound, OfLeastDepthInSandIsFlaggedWithTheInfiniteSlopesFactor) {
    const json text = small::scene(
        {{"sand", small::soil(20, 0, 35)}},
        json::array({small::region("sand", "sand",
                                   {{0, -15}, {90, -15}, {90, 0}, {60, 0}, {40, 10}, {0, 10}})}),
        {{"search", {{"entry", {2, 45}}, {"exit", {45, 85}}, {"minimum_depth", 3}}}});
    const Analysed found = analysed(text);
    const fault::Flag* flag = found.flag("bound_raises_factor", "/lem/search/minimum_depth");
    ASSERT_NE(flag, nullptr);
    EXPECT_NE(flag->message.find("1.40"), std::string::npos)  // tan 35 / 0.5
        << flag->message;
}

TEST(UpstreamEnd, CloserThanTheSlopesHeightIsFlaggedOnEitherSide) {
    json near = bank({{"search", {{"entry", {2, 39}}, {"exit", {45, 85}}}}});
    const Analysed far = analysed(near);
    EXPECT_EQ(far.flag("upstream_wall", "/section/regions"), nullptr);
    for (json& region : near["section"]["regions"])
        for (json& point : region["polygon"])
            if (point[0] == 0) point[0] = 30;
    near["lem"]["search"]["entry"] = {30.5, 39};
    const Analysed found = analysed(near);
    const fault::Flag* flag = found.flag("upstream_wall", "/section/regions");
    ASSERT_NE(flag, nullptr);
    EXPECT_NE(flag->message.find("x = 30 m"), std::string::npos) << flag->message;
}

TEST(OneAnswer, LeavesOutWhatIsNotValidAndSaysSo) {
    const scene::Scene scene =
        small::parsed(small::two_layers({{"search", small::some_search().at("search")},
                                         {"circle", small::some_circle().at("circle")}}));
    const Model model = make_model(scene);
    const Families families = search_families(scene, model, *scene.lem->search, 1);
    json given = facts_of(given_family(scene, model).circles);
    given["factor_of_safety"] = 0.5;
    given["spencer"] = nullptr;
    given["least_m_alpha"] = 0.19;
    const json small_m_alpha = answer(scene, families, {{"given_circle", given}});
    EXPECT_EQ(small_m_alpha.at("surface"), "circle");
    const auto flags = flags_of_answer(small_m_alpha, *scene.lem);
    ASSERT_EQ(flags.size(), 1u);
    EXPECT_EQ(flags[0].code, "surfaces_disagree");
    EXPECT_EQ(flags[0].severity, fault::Severity::questionable);
    EXPECT_NE(flags[0].message.find("0.500"), std::string::npos);
    given["least_m_alpha"] = 0.21;
    const json valid = answer(scene, families, {{"given_circle", given}});
    EXPECT_EQ(valid.at("surface"), "given_circle");
    EXPECT_EQ(valid.at("factor_of_safety"), 0.5);
    EXPECT_TRUE(flags_of_answer(valid, *scene.lem).empty());
}

}  // namespace
}  // namespace breach::lem
