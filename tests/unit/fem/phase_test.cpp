// The plan follows the scene; supports that hold nothing are refused; the model's laws follow the
// stage.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/telemetry/columns.hpp"
#include "fem_solver/model/build_model.hpp"
#include "fem_solver/monitors/monitors.hpp"
#include "fem_solver/run.hpp"
#include "fem_solver/snapshot.hpp"

namespace breach::fem {
namespace {

using nlohmann::json;

json slope() {
    std::ifstream in(std::string(BREACH_ROOT) + "/workflows/scenes/slope.json");
    return json::parse(in);
}

scene::Scene parse(const json& text) { return scene::parse_scene(text.dump(), "test"); }

process::Use use_of(const process::Plan& plan, const std::string& feature) {
    const auto line = std::ranges::find_if(
        plan, [&](const auto& each) { return each.feature.starts_with(feature); });
    EXPECT_NE(line, plan.end()) << feature;
    return line->use;
}

TEST(Plan, OfTheSlopeHasSofteningAndNoWater) {
    const process::Plan p = plan(parse(slope()));
    for (const char* feature : {"gravity", "plasticity", "softening", "inertia"}) {
        EXPECT_EQ(use_of(p, feature), process::Use::on) << feature;
    }
    for (const char* feature :
         {"pore pressure", "absorbing base", "free-field columns", "base motion",
          "liquefied layers", "Rayleigh", "gmsh", "moving mesh"}) {
        EXPECT_EQ(use_of(p, feature), process::Use::left_out) << feature;
    }
    for (const process::PlanLine& line : p) EXPECT_FALSE(line.pointer.empty()) << line.feature;
}

TEST(Plan, FollowsTheScene) {
    json scene = slope();
    scene["fem"]["rayleigh_mass"] = 0.1;
    scene["fem"]["kinematics"] = "updated_lagrangian";
    const process::Plan p = plan(parse(scene));
    EXPECT_EQ(use_of(p, "Rayleigh"), process::Use::on);
    EXPECT_EQ(use_of(p, "moving mesh"), process::Use::on);
}

TEST(Model, RefusesASupportThatHoldsNothing) {
    json scene = slope();
    scene["fem"]["supports"][0]["from"] = {-100, 0};
    scene["fem"]["supports"][0]["to"] = {-100, 1};
    const scene::Scene parsed = parse(scene);
    try {
        build_model(parsed, build_mesh(parsed, "."));
        FAIL();
    } catch (const fault::BadInput& error) {
        ASSERT_EQ(error.faults().size(), 1u);
        EXPECT_EQ(error.faults()[0].pointer, "/fem/supports/0");
    }
}

TEST(Model, HasElasticLawsInAnElasticStage) {
    const scene::Scene parsed = parse(slope());
    const Model model = build_model(parsed, build_mesh(parsed, "."));
    ASSERT_EQ(model.zones.size(), 2u);
    for (const auto& law : laws_for(model, scene::StageLaws::elastic)) {
        EXPECT_TRUE(std::holds_alternative<materials::LinearElastic>(law));
    }
    EXPECT_TRUE(std::holds_alternative<materials::MohrCoulomb>(
        laws_for(model, scene::StageLaws::scene)[1]));
}

/// Triggers, reports and the page read these names from the one table.
TEST(Telemetry, HasTheColumnsOfTheTable) {
    std::vector<std::string> wanted{"phase"}, written;
    for (const telemetry::Column& each : telemetry::fem_columns()) wanted.emplace_back(each.name);
    const json line = telemetry_line(Reading{});
    for (const auto& [name, value] : line.items()) written.push_back(name);
    std::vector<std::string> kept;
    for (const Column& each : columns()) kept.emplace_back(each.name);
    EXPECT_EQ(kept, std::vector<std::string>(wanted.begin() + 1, wanted.end())) << "in this order";
    std::ranges::sort(wanted);
    std::ranges::sort(written);
    EXPECT_EQ(written, wanted);
}

TEST(Snapshot, IsNamedAfterItsTime) { EXPECT_EQ(snapshot_name(0.25), "snapshot_0.250000.vtkhdf"); }

}  // namespace
}  // namespace breach::fem
