// NorSand in the LEM: undrained strength equals that of the law's own path, moments are checked by
// hand, and purely drained strength is flagged.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/materials/norsand/undrained.hpp"
#include "core/scene/reading.hpp"
#include "lem_tool/drained.hpp"
#include "lem_tool/limit_scene.hpp"
#include "small_scenes.hpp"

namespace breach::lem {
namespace {

using materials::NorSand;
using materials::OnPath;
using nlohmann::json;

const std::string lift = BREACH_ROOT "/workflows/scenes/static_lift.json";

scene::Scene with(const std::vector<std::string>& overrides = {}) {
    return scene::read_scene(lift, overrides);
}

NorSand tailings(const scene::Scene& scene) {
    for (const scene::Region& region : scene.section.regions)
        if (const auto* law = std::get_if<NorSand>(&scene.materials[region.material].law))
            return *law;
    throw std::logic_error("no NorSand");
}

/// The law's path in simple shear at this stress, not tabulated.
double ratio_by_path(const NorSand& law, double sigma_v0, OnPath part) {
    const double K_0 = materials::K_0(law);
    const auto begun = beginning(law, {-K_0 * sigma_v0, -sigma_v0, -K_0 * sigma_v0, 0.0});
    const auto found =
        materials::norsand::simple_shear_strength(law.ready, begun.state, 20.0 * sigma_v0);
    return (part == OnPath::peak ? found.peak : found.residual) / sigma_v0;
}

TEST(NorSandByState, PeakInSimpleShearIsTheReferencesTables) {
    // CJ1, psi_0 = 0.05, K_0 = 0.7, S = 1: 0.253556 (docs/verification/static_liquefaction.md).
    const NorSand law = tailings(with());
    EXPECT_NEAR(ratio_by_path(law, 100e3, OnPath::peak), 0.253556, 1e-3 * 0.253556);
}

TEST(NorSandByState, TheTableIsThePathBetweenItsRowsToo) {
    for (const OnPath part : {OnPath::peak, OnPath::residual}) {
        const NorSand law = tailings(with());
        const auto table = undrained_by_place(law, part);
        for (const double sigma_v0 : {7.3e3, 41e3, 133e3, 420e3}) {
            const double s_u = table({5.0, 0.0, sigma_v0}, 20.0 * sigma_v0);
            // At a few kPa the floor p_min puts a kink between two rows.
            const double allowed = sigma_v0 < 10e3 ? 3e-2 : 1e-2;
            EXPECT_NEAR(s_u / sigma_v0 / ratio_by_path(law, sigma_v0, part), 1.0, allowed)
                << sigma_v0 << " Pa";
        }
    }
}

TEST(NorSandByState, ResidualIsTheCriticalStatesShearAtTheVoidRatioThatStays) {
    const NorSand law = tailings(with());
    const double sigma_v0 = 100e3, K_0 = materials::K_0(law);
    const auto begun = beginning(law, {-K_0 * sigma_v0, -sigma_v0, -K_0 * sigma_v0, 0.0});
    const double theta = materials::norsand::plane_critical_angle(law.ready);
    const double expected = materials::norsand::critical_ratio(law.ready, theta) * std::cos(theta) /
                            std::numbers::sqrt3 *
                            materials::norsand::critical_pressure(law.ready, begun.state.e);
    const auto table = undrained_by_place(law, OnPath::residual);
    EXPECT_NEAR(table({5.0, 0.0, sigma_v0}, sigma_v0) / expected, 1.0, 5e-3);
}

/// Level-bedded wet NorSand cut to a 45-degree face; a circle about a point above the toe.
json bank(const json& lem) {
    const json soil = json::parse(scene::text_of(lift)).at("materials").at("tailings");
    const small::Ring ring{{0, 0}, {60, 0}, {60, 10}, {30, 10}, {20, 20}, {0, 20}};
    return small::scene({{"tailings", soil}},
                        json::array({small::region("tailings", "tailings", ring)}), lem);
}

double safety(const json& lem) {
    return small::circle_bishop(limit_scene(small::parsed(bank(lem)))).factor_of_safety;
}

json lem_with(const json& undrained) {
    return {{"circle", {{"center", {30, 24}}, {"radius", 18}}},
            {"water", {{"line", {{0, 20}, {20, 20}, {30, 10}, {60, 10}}}}},
            {"undrained", undrained},
            {"slices", 200}};
}

TEST(NorSandByState, FactorOfSafetyIsThatOfTheSameStrengthGivenByHand) {
    // Where the table's ratio is constant, s_u = ratio sigma'_v0 can also be given in
    // /lem/undrained.
    const double by_state = safety(lem_with({{{"region", "tailings"}, {"norsand", "peak"}}}));
    double least = 1e9, most = 0.0;
    const NorSand law = tailings(with());
    for (const double sigma_v0 : {5e3, 50e3, 150e3}) {
        const double ratio = ratio_by_path(law, sigma_v0, OnPath::peak);
        const double F =
            safety(lem_with({{{"region", "tailings"}, {"coefficient_kPa", 101.325 * ratio}}}));
        least = std::min(least, F);
        most = std::max(most, F);
    }
    std::printf("F by state %.4f, by constant ratios %.4f to %.4f\n", by_state, least, most);
    EXPECT_GE(by_state, 0.999 * least);
    EXPECT_LE(by_state, 1.001 * most);
    EXPECT_LT(safety(lem_with({{{"region", "tailings"}, {"norsand", "residual"}}})),
              0.9 * by_state);
}

TEST(NorSandByState, FactorOfSafetyIsThatOfTheIntegralsOverTheCircle) {
    // phi = 0: F = R int s_u dl / int W (x_c - x) dx. Water at the ground, so sigma'_v0 = (gamma -
    // gamma_w) d, and s_u is a constant ratio of it. Independent of the tool.
    constexpr double x_c = 30.0, y_c = 24.0, R = 18.0, gamma = 19.5e3, gamma_w = 10e3;
    const double ratio = ratio_by_path(tailings(with()), 50e3, OnPath::peak);
    const double from = x_c - std::sqrt(R * R - (20.0 - y_c) * (20.0 - y_c));
    const double to = x_c + std::sqrt(R * R - (10.0 - y_c) * (10.0 - y_c));
    constexpr int parts = 100000;
    const double dx = (to - from) / parts;
    double resisting = 0.0, driving = 0.0;
    for (int i = 0; i < parts; ++i) {
        const double x = from + (i + 0.5) * dx;
        const double cosine = std::sqrt(1.0 - (x - x_c) * (x - x_c) / (R * R));
        const double depth = std::clamp(40.0 - x, 10.0, 20.0) - (y_c - R * cosine);
        resisting += R * ratio * (gamma - gamma_w) * depth * dx / cosine;
        driving += gamma * depth * (x_c - x) * dx;
    }
    const double expected = resisting / driving;
    const double F = safety(lem_with({{{"region", "tailings"}, {"norsand", "peak"}}}));
    std::printf("F %.5f, by the integrals %.5f\n", F, expected);
    EXPECT_NEAR(F / expected, 1.0, 2e-3);
}

TEST(NorSandByState, WeightThatHasNotConsolidatedGivesNoStrength) {
    const auto factor = [](const std::vector<std::string>& overrides) {
        return small::circle_bishop(limit_scene(with(overrides))).factor_of_safety;
    };
    const std::string circle = R"(/lem/circle={"center":[52,40],"radius":42})";
    const double fast = factor({circle});
    const double slow = factor({circle, "/lem/unconsolidated=[]"});
    EXPECT_LT(fast, 0.97 * slow);
}

TEST(NorSandByState, WhatContradictsItselfIsRefused) {
    const auto pointer_of = [](const std::string& entry) -> std::string {
        try {
            with({"/lem/undrained=[" + entry + "]"});
        } catch (const fault::BadInput& refusal) {
            return refusal.faults().at(0).pointer;
        }
        return "";
    };
    EXPECT_EQ(pointer_of(R"({"region":"dike","norsand":"peak"})"), "/lem/undrained/0/norsand");
    EXPECT_EQ(pointer_of(R"({"region":"tailings","norsand":"peak","strength_kPa":5})"),
              "/lem/undrained/0/norsand");
}

TEST(DrainedOnly, IsFlaggedWhereLooseWetSoilIsJudgedByIt) {
    const auto flags_with = [&](const std::string& more) {
        std::vector<std::string> overrides{"/lem/undrained=[]"};
        if (!more.empty()) overrides.push_back(more);
        return flags_of_drained(with(overrides));
    };
    ASSERT_EQ(flags_with("").size(), 1u);
    EXPECT_EQ(flags_with("")[0].code, "drained_only");
    EXPECT_TRUE(flags_with("/materials/tailings/law/psi_0=-0.05").empty()) << "dense";
    EXPECT_TRUE(flags_with("/lem/water/line=[[0,-50],[88,-50]]").empty()) << "dry";
    EXPECT_TRUE(
        flags_with(R"(/lem/liquefaction=[{"region":"tailings","norsand":"residual"}])").empty());
    EXPECT_TRUE(flags_of_drained(with()).empty()) << "the shipped scene says how it fails";
}

/// The loose bank, 20 m of tailings with friction only; `more` is added to /lem.
std::vector<fault::Flag> flags_of_bank(const json& more, const json& state = {{"psi_0", 0.05}}) {
    json text = bank({{"circle", {{"center", {30, 24}}, {"radius", 18}}}});
    text["lem"].update(more);
    json& law = text["materials"]["tailings"]["law"];
    law.erase("psi_0");
    law.update(state);
    return flags_of_drained(small::parsed(text));
}

const json high = {{"line", {{0, 20}, {20, 20}, {30, 10}, {60, 10}}}};
json named(json line, const std::string& region) {
    line["regions"] = {region};
    return line;
}

TEST(DrainedOnly, IsWetByAnyWaterOfTheAnalysis) {
    EXPECT_EQ(flags_of_bank({{"water", high}}).size(), 1u);
    EXPECT_EQ(flags_of_bank({{"piezometric_lines", {named(high, "tailings")}}}).size(), 1u);
    EXPECT_EQ(
        flags_of_bank({{"pore_pressure_ratios", {{{"region", "tailings"}, {"r_u", 0.3}}}}}).size(),
        1u);
    // A mound of water between corners above it.
    EXPECT_EQ(flags_of_bank({{"water", {{"line", {{0, -1}, {10, 5}, {20, -1}}}}}}).size(), 1u);
    EXPECT_TRUE(flags_of_bank(json::object()).empty()) << "dry";
    const json low = {{"line", {{0, -5}, {60, -5}}}};
    EXPECT_TRUE(
        flags_of_bank({{"water", high}, {"piezometric_lines", {named(low, "tailings")}}}).empty())
        << "its own line lies below it, whatever the others' does";
}

TEST(DrainedOnly, IsLooseWhereItIsWet) {
    const auto with_state = [](const json& state) {
        return flags_of_bank({{"water", high}}, state).size();
    };
    // CJ1's e_c at 100 kPa is 0.9 - 0.02 ln 100: denser than critical there, looser below about 14
    // m.
    const double at_100_kPa = 0.9 - 0.02 * std::log(100.0);
    EXPECT_EQ(with_state({{"e_0", at_100_kPa - 0.0005}}), 1u);
    EXPECT_EQ(with_state({{"e_0", at_100_kPa - 0.05}}), 0u);
    const auto by_elevation = [](const json& points) -> json {
        return {{"psi_0_profile", {{"by", "elevation"}, {"points", points}}}};
    };
    EXPECT_EQ(with_state(by_elevation({{2, 0.05}, {4, -0.05}})), 1u);
    const json half = {{"line", {{0, 8}, {60, 8}}}};
    EXPECT_TRUE(flags_of_bank({{"water", half}}, by_elevation({{10, -0.05}, {14, 0.05}})).empty())
        << "loose above the water alone";
}

TEST(DrainedOnly, IsForWhatHasFriction) {
    const auto with_strength = [](const std::string& entry) {
        return flags_of_drained(
                   with({"/lem/undrained=[]", "/materials/tailings/limit_strength=" + entry}))
            .size();
    };
    EXPECT_EQ(with_strength(R"({"c_kPa": 0, "phi_deg": 30})"), 1u);
    EXPECT_EQ(with_strength(R"({"c_kPa": 25, "phi_deg": 0})"), 0u);
}

TEST(DrainedOnly, IsForWhatNoLayerThatLiquefiesHolds) {
    const auto with_layer = [](const json& levels) {
        json layer{{"region", "tailings"}, {"norsand", "residual"}, {"levels", levels}};
        return flags_of_bank({{"water", high},
                              {"search", {{"entry", {2, 19}}, {"exit", {31, 58}}}},
                              {"liquefaction", json::array({layer})}})
            .size();
    };
    EXPECT_EQ(with_layer({10, 20}), 1u) << "its lower half is judged by friction";
    EXPECT_EQ(with_layer({0, 20}), 0u);
}

}  // namespace
}  // namespace breach::lem
