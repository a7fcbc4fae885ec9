// One strength profile in LEM, transfer and MPM: equal at one place.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/check/check.hpp"
#include "core/scene/ground.hpp"
#include "lem_tool/arc.hpp"
#include "lem_tool/limit_scene.hpp"
#include "lem_tool/search.hpp"
#include "lem_tool/slip_circle.hpp"
#include "mpm_solver/body/body.hpp"
#include "mpm_solver/body/fill.hpp"
#include "mpm_solver/step.hpp"
#include "tests/verification/transfer/meshes.hpp"

namespace breach::strengths_test {
namespace {

using mechanics::Vec2;
using nlohmann::json;

json soil(const json& strength) {
    return {{"density", 1800},
            {"strength", strength},
            {"law", {{"type", "mohr_coulomb"}, {"E_MPa", 20}, {"nu", 0.3}}}};
}

/// A slope 12 m wide and 10 m high, with inclined water and free water at its foot.
json slope(const json& material) {
    return {{"format", "breachline-scene/1"},
            {"name", "slope"},
            {"materials", {{"soil", material}}},
            {"section",
             {{"regions",
               {{{"name", "slope"},
                 {"material", "soil"},
                 {"polygon", {{0, 0}, {12, 0}, {12, 4}, {10, 4}, {5, 10}, {0, 10}, {0, 0}}}}}}}},
            {"lem",
             {{"circle", {{"center", {8.5, 11}}, {"radius", 7.433}}},
              {"search", {{"entry", {1, 4}}, {"exit", {10, 12}}}},
              {"water", {{"line", {{0, 8}, {8, 5}, {12, 5}}}, {"correction", "cos2"}}},
              {"liquefaction", {{{"region", "slope"}}}}}},
            {"transfer", {{"liquefied", {{"regions", {"slope"}}}}}},
            {"mpm",
             {{"cell_size", 0.5},
              {"domain_x", {0, 20}},
              {"domain_y", {0, 12}},
              {"left", "roller"},
              {"right", "roller"},
              {"floor", {{"level", 0}, {"friction", json::array()}}},
              {"duration", 0.1},
              {"snapshot_interval", 0.1},
              {"runout", {{"toe", {10, 4}}}}}}};
}

json profile() {
    return {{"peak", {{"type", "undrained_ratio"}, {"ratio", 0.28}, {"minimum_kPa", 2}}},
            {"residual", {{"type", "relation"}, {"relation", "weber_2015"}, {"value", 6}}},
            {"softening", {{"epsilon_q_start", 0.02}, {"epsilon_q_end", 0.2}}}};
}

scene::Scene parsed(const json& text) { return scene::parse_scene(text.dump(), "slope"); }

/// The undeformed mesh over the section; elements above the slope are not used.
exchange::MeshSnapshot mesh(const std::function<double(const Vec2&)>& r_u) {
    auto snapshot = transfer::meshes::grid({.nx = 12, .ny = 10});
    snapshot.regions = {"slope"};
    transfer::meshes::soak(snapshot, 10.0, r_u);
    return snapshot;
}

/// Strength of a point there in the transfer.
materials::PointStrength in_transfer(const transfer::SoilMap& map, const Vec2& place) {
    const Vec2 corner{std::floor(place.x()), std::floor(place.y())};
    const auto element = static_cast<std::size_t>(12 * corner.y() + corner.x());
    return map.strength_at(element, 2.0 * (place - corner) - Vec2(1.0, 1.0));
}

TEST(OneProfile, IsOneStrengthAtASliceATransferredPointAndAPointOfTheMPM) {
    const scene::Scene scene = parsed(slope(soil(profile())));
    const auto dry = mesh([](const Vec2&) { return 0.0; });
    const auto liquid = mesh([](const Vec2&) { return 1.0; });
    const transfer::SoilMap firm(dry, scene, "dry");
    const transfer::SoilMap liquefied(liquid, scene, "liquid");

    const scene::Scene limit = lem::limit_scene(scene);
    const lem::Model model = lem::make_model(limit);
    const auto after = lem::liquefied(model, limit.lem->liquefaction, 1);
    lem::Slices slices = lem::make_slices(model.strata, 40);
    const lem::Surface surface = lem::masses_of(model.strata, *limit.lem->circle).at(0);
    std::size_t wet = 0;
    for (const auto* soils : {&model.soils, &after}) {
        ASSERT_EQ(lem::cut(model.strata, *soils, surface, 40, slices), lem::Cut::done);
        for (std::size_t i = 0; i < slices.count; ++i) {
            const Vec2 base{slices.left[i] + 0.5 * slices.width[i], slices.base[i]};
            const bool flows = soils == &after && slices.u[i] > 0.0;
            wet += flows ? 1 : 0;
            const double c = in_transfer(flows ? liquefied : firm, base).c;
            EXPECT_NEAR(slices.c[i], c, 1e-10 * c) << base.transpose();
            EXPECT_EQ(slices.tan_phi[i], 0.0);
        }
    }
    EXPECT_GT(wet, 5u);
    EXPECT_LT(wet, slices.count) << "above the phreatic line nothing liquefies";

    const mpm::FilledSection filled = mpm::fill_section(scene);
    const mpm::ZonedPoints zoned = mpm::zoned_points(scene, filled.state, "filled");
    ASSERT_EQ(zoned.points.c.size(), zoned.points.size());
    for (std::size_t p = 0; p < zoned.points.size(); ++p) {
        const materials::PointStrength there =
            in_transfer(firm, {zoned.points.x[p], zoned.points.y[p]});
        EXPECT_NEAR(zoned.points.c[p], there.c, 1e-10 * there.c);
        EXPECT_NEAR(zoned.points.c_residual[p], there.c_residual, 1e-10 * there.c_residual);
    }
}

TEST(OneProfile, SoilThatAStageHasRemovedWeighsNothing) {
    const json alone = slope(soil(profile()));
    json lifted = alone;
    lifted["section"]["regions"].push_back(
        {{"name", "lift"},
         {"material", "soil"},
         {"polygon", {{0, 10}, {5, 10}, {5, 12}, {0, 12}, {0, 10}}}});
    const scene::Scene without = parsed(alone), with = parsed(lifted);
    // The snapshot has no element of the lift.
    const auto snapshot = mesh([](const Vec2&) { return 0.0; });
    const transfer::SoilMap of_section(snapshot, without, "test"), of_rest(snapshot, with, "test");
    const Vec2 place(2.5, 9.5);
    const double c = in_transfer(of_section, place).c;
    EXPECT_NEAR(c, 0.28 * 1800.0 * without.gravity * 0.5, 1e-9 * c);
    EXPECT_EQ(in_transfer(of_rest, place).c, c);
    const double under_lift =
        materials::strength_of_point(*with.materials[0].strength, scene::Ground(with).at(place, 0),
                                     materials::Liquefaction::before)
            .c;
    EXPECT_NEAR(under_lift, 5.0 * c, 1e-9 * c) << "as drawn: 2 m more above 0.5 m";
}

TEST(OneProfile, LiquefiedPointsComeWithTheirResidualStrengthAndKeepItInTheMPM) {
    json text = slope(soil(profile()));
    text["section"]["regions"][0]["polygon"] = {{0, 0}, {12, 0}, {12, 10}, {0, 10}, {0, 0}};
    text["thickness"] = 1.5;  // the mesh's
    const scene::Scene scene = parsed(text);
    const auto snapshot =
        mesh([](const Vec2& x) { return x.x() < 5.5 && x.y() > 4.5 ? 1.0 : 0.0; });
    const auto t = transfer::meshes::transferred(snapshot, scene);
    const scene::Ground ground(scene);
    const mpm::ZonedPoints zoned = mpm::zoned_points(scene, t.state, "transferred");
    std::size_t flowing = 0;
    for (std::size_t p = 0; p < t.state.size(); ++p) {
        const materials::Place place = ground.at(t.state.position[p], 0);
        const Vec2& at = t.state.position[p];
        const bool at_edge = (at.x() > 3.9 && at.x() < 6.5) || (at.y() > 3.9 && at.y() < 6.1);
        if (at_edge) continue;
        const auto liquefaction = at.x() < 5.0 && at.y() > 5.0 ? materials::Liquefaction::liquefied
                                                               : materials::Liquefaction::before;
        const auto expected =
            materials::strength_of_point(*scene.materials[0].strength, place, liquefaction);
        EXPECT_NEAR(t.state.strength.c[p], expected.c, 1e-9) << at.transpose();
        EXPECT_NEAR(t.state.strength.c_residual[p], expected.c_residual, 1e-9);
        flowing += liquefaction == materials::Liquefaction::liquefied ? 1 : 0;
    }
    EXPECT_GT(flowing, 50u);
    for (std::size_t p = 0; p < zoned.points.size(); ++p) {
        const auto from = static_cast<std::size_t>(zoned.points.number[p]);
        EXPECT_EQ(zoned.points.c[p], t.state.strength.c[from]);
    }
    EXPECT_EQ(mpm::particle_state(scene, zoned.points).strength.c, t.state.strength.c);
    exchange::ParticleState without = t.state;
    without.strength = {};
    EXPECT_THROW(mpm::zoned_points(scene, without, "old"), fault::BadInput);
}

/// With a uniform profile, the law of each point equals the material's.
TEST(OneProfile, ThatIsUniformMovesTheSoilAsTheLawsOwnEntriesDo) {
    json old = soil(json::object());
    old.erase("strength");
    old["law"].update({{"c_kPa", 6},
                       {"phi_deg", 30},
                       {"psi_deg", 5},
                       {"softening",
                        {{"epsilon_q_start", 0.01},
                         {"epsilon_q_end", 0.1},
                         {"c_residual_kPa", 1},
                         {"phi_residual_deg", 0}}}});
    json once = soil({{"peak", {{"type", "effective"}, {"c_kPa", 6}, {"phi_deg", 30}}},
                      {"residual", {{"type", "undrained"}, {"s_u_kPa", 1}}},
                      {"softening", {{"epsilon_q_start", 0.01}, {"epsilon_q_end", 0.1}}}});
    once["law"]["psi_deg"] = 5;
    std::vector<mpm::Points> ends;
    for (const json& each : {old, once}) {
        json text = slope(each);
        text.erase("lem");
        text.erase("transfer");
        const scene::Scene scene = parsed(text);
        mpm::Body body = mpm::make_body(
            scene, mpm::zoned_points(scene, mpm::fill_section(scene).state, "filled"), "filled",
            {});
        for (int k = 0; k < 400; ++k) mpm::step(body, 1e-3);
        ends.push_back(body.points);
    }
    ASSERT_EQ(ends[0].size(), ends[1].size());
    double softened = 0.0;
    for (std::size_t p = 0; p < ends[0].size(); ++p) {
        EXPECT_NEAR(ends[0].y[p], ends[1].y[p], 1e-9);
        softened = std::max(softened, ends[0].epsilon_q_plastic[p]);
    }
    EXPECT_GT(softened, 0.05) << "or nothing was compared";
}

/// Residual by depth: each point ends at its own.
TEST(OneProfile, SoftensEveryPointToItsOwnResidualStrength) {
    json text = slope(
        soil({{"peak", {{"type", "undrained"}, {"s_u_kPa", 20}}},
              {"residual",
               {{"type", "undrained_by_depth"}, {"at_ground_kPa", 0.5}, {"per_metre_kPa", 0.25}}},
              {"softening", {{"epsilon_q_start", 0}, {"epsilon_q_end", 0.02}}}}));
    text["mpm"]["anti_locking"] = "off";
    text["mpm"]["gap_closure"] = false;
    const scene::Scene scene = parsed(text);
    mpm::Body body = mpm::make_body(
        scene, mpm::zoned_points(scene, mpm::fill_section(scene).state, "filled"), "filled", {});
    for (std::size_t p = 0; p < body.points.size(); ++p) {
        body.points.epsilon_q_plastic[p] = 1.0;
        body.points.Lxy[p] = 1.0;
    }
    mpm::update_stress(body, 0.1);
    const scene::Ground ground(scene);
    for (std::size_t p = 0; p < body.points.size(); ++p) {
        const double depth = ground.at({body.points.x[p], body.points.y[p]}, 0).depth;
        const double tau =
            std::hypot(body.points.sxy[p], 0.5 * (body.points.sxx[p] - body.points.syy[p]));
        EXPECT_NEAR(tau, 500.0 + 250.0 * depth, 1e-6);
    }
}

std::vector<std::string> warned(const json& text, const std::string& code) {
    const check::Checked checked = check::checked_text(text.dump(), "slope", ".", {});
    EXPECT_TRUE(checked.faults.empty())
        << checked.faults.front().pointer << ' ' << checked.faults.front().cause;
    std::vector<std::string> pointers;
    for (const fault::Flag& each : checked.scene.warnings)
        if (each.code == code) pointers.push_back(each.pointer + " | " + each.message);
    return pointers;
}

TEST(TwoStrengths, OfOneSoilAreFlaggedWithBothPlacesAndValues) {
    EXPECT_TRUE(warned(slope(soil(profile())), "strengths_differ").empty());
    json text = slope(soil(profile()));
    text["lem"]["liquefaction"][0]["residual_strength_kPa"] = 1.0;
    auto told = warned(text, "strengths_differ");
    ASSERT_EQ(told.size(), 1u);
    EXPECT_NE(told[0].find("/lem/liquefaction/0"), std::string::npos) << told[0];
    EXPECT_NE(told[0].find("/materials/soil/strength/residual"), std::string::npos) << told[0];
    EXPECT_NE(told[0].find("1 kPa"), std::string::npos) << told[0];

    text = slope(soil({{"peak", {{"type", "effective"}, {"c_kPa", 5}, {"phi_deg", 30}}}}));
    text.erase("transfer");
    text["lem"].erase("liquefaction");
    EXPECT_TRUE(warned(text, "strengths_differ").empty());
    text["materials"]["soil"]["limit_strength"] = {{"c_kPa", 5}, {"phi_deg", 36}};
    told = warned(text, "strengths_differ");
    ASSERT_EQ(told.size(), 1u);
    EXPECT_NE(told[0].find("/materials/soil/limit_strength"), std::string::npos);
}

/// Without a profile: compares equal kinds, never peak with residual.
TEST(TwoStrengths, AreFoundWithoutAProfileToo) {
    json law = soil(json::object());
    law.erase("strength");
    law["law"].update({{"c_kPa", 5}, {"phi_deg", 30}});
    json text = slope(law);
    text.erase("transfer");
    text["lem"]["liquefaction"][0]["residual_strength_kPa"] = 3.0;
    EXPECT_TRUE(warned(text, "strengths_differ").empty());
    text["materials"]["soil"]["limit_strength"] = {{"c_kPa", 5}, {"phi_deg", 31}};
    EXPECT_TRUE(warned(text, "strengths_differ").empty()) << "less than 5 %";
    text["materials"]["soil"]["limit_strength"] = {{"c_kPa", 25}, {"phi_deg", 0}};
    EXPECT_TRUE(warned(text, "strengths_differ").empty()) << "undrained beside drained";
    text["materials"]["soil"]["limit_strength"] = {{"c_kPa", 15}, {"phi_deg", 30}};
    EXPECT_EQ(warned(text, "strengths_differ").size(), 1u);
}

TEST(Relations, OutsideTheirRangeAreFlaggedWithIt) {
    json text = slope(soil(profile()));
    EXPECT_TRUE(warned(text, "outside_relation").empty());
    text["materials"]["soil"]["strength"]["residual"] = {
        {"type", "relation"}, {"relation", "olson_stark_2002_cpt"}, {"points", {{0, 5}, {10, 9}}}};
    const auto told = warned(text, "outside_relation");
    ASSERT_EQ(told.size(), 1u);
    EXPECT_NE(told[0].find("from 0 to 6.5"), std::string::npos) << told[0];
}

std::string refused(const json& text) {
    const check::Checked checked = check::checked_text(text.dump(), "slope", ".", {});
    return checked.faults.empty() ? "" : checked.faults.front().pointer;
}

TEST(Profiles, AreRefusedWhereTheyCannotBeMeant) {
    const auto with = [](const json& strength) { return refused(slope(soil(strength))); };
    const json peak{{"type", "undrained"}, {"s_u_kPa", 20}};
    EXPECT_EQ(with({{"residual", peak}}), "/materials/soil/strength");
    EXPECT_EQ(with({{"like", "soil"}}), "/materials/soil/strength/like");
    EXPECT_EQ(with({{"like", "soil"}, {"peak", peak}}), "/materials/soil/strength");
    EXPECT_EQ(with({{"peak", {{"type", "relation"}, {"relation", "weber_2015"}, {"value", 6}}}}),
              "/materials/soil/strength/peak/type");
    EXPECT_EQ(
        with({{"peak", peak}, {"residual", {{"type", "relation"}, {"relation", "somebody_2099"}}}}),
        "/materials/soil/strength/residual/relation");
    EXPECT_EQ(
        with({{"peak", peak}, {"residual", {{"type", "relation"}, {"relation", "weber_2015"}}}}),
        "/materials/soil/strength/residual");
    EXPECT_EQ(with({{"peak", {{"type", "undrained_table"}, {"points", {{4, 5}, {2, 6}}}}}}),
              "/materials/soil/strength/peak/points/1");
    EXPECT_EQ(with({{"peak", peak}, {"softening", {{"epsilon_q_start", 0}, {"epsilon_q_end", 1}}}}),
              "/materials/soil/strength/softening");
    EXPECT_EQ(with({{"peak", peak}, {"residual", {{"type", "undrained"}, {"s_u_kPa", 30}}}}),
              "/materials/soil/strength/residual");
    EXPECT_EQ(with({{"peak", peak}}), "/transfer/liquefied/regions/0") << "no residual";
    json half = slope(soil(profile()));
    half["materials"]["soil"]["law"]["c_kPa"] = 3;
    EXPECT_EQ(refused(half), "/materials/soil/law");
}

}  // namespace
}  // namespace breach::strengths_test
