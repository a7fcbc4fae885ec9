// The plan follows the scene; supports without nodes are refused; the model's laws follow the
// stage.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/telemetry/columns.hpp"
#include "fem_solver/choose.hpp"
#include "fem_solver/model/build_model.hpp"
#include "fem_solver/monitors/monitors.hpp"
#include "fem_solver/monitors/viscous_share.hpp"
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
    for (const char* feature : {"pore pressure", "absorbing base", "free-field columns",
                                "base motion", "liquefied layers", "Rayleigh", "gmsh"}) {
        EXPECT_EQ(use_of(p, feature), process::Use::left_out) << feature;
    }
    for (const process::PlanLine& line : p) EXPECT_FALSE(line.pointer.empty()) << line.feature;
}

TEST(Plan, FollowsTheScene) {
    json scene = slope();
    scene["fem"]["rayleigh_mass"] = 0.1;
    const process::Plan p = plan(parse(scene));
    EXPECT_EQ(use_of(p, "Rayleigh"), process::Use::on);
}

TEST(Plan, PrintsTheDecisionsThemselves) {
    const scene::Scene parsed = parse(slope());
    Decisions decided = decide(parsed);
    for (process::PlanLine* line : {&decided.model.element.line, &decided.run.memory.line,
                                    &decided.run.liquefaction.line, &decided.mesher.line}) {
        line->reason = "told by " + line->feature;
    }
    int told = 0;
    for (const process::PlanLine& line : plan_of(decided, parsed))
        told += line.reason == "told by " + line.feature;
    EXPECT_EQ(told, 4);
}

TEST(Model, IsBuiltFromTheDecisionsThatThePlanPrints) {
    const scene::Scene parsed = parse(slope());
    ModelDecisions decided = decide_model(parsed);
    const Mesh mesh = build_mesh(parsed, ".");
    const Model as_asked = build_model(parsed, decided, mesh);
    EXPECT_EQ(as_asked.points_per_element, 4u);
    EXPECT_LT(as_asked.external_force.minCoeff(), 0.0);
    decided.gravity.value = 0.0;
    decided.element.value = HourglassModulus::elastic;
    decided.damping.value.mass = 0.5;
    decided.surcharge.value = {{.from = 0.0, .to = 1e3, .pressure = 1e4}};
    const Model as_decided = build_model(parsed, decided, mesh);
    EXPECT_EQ(as_decided.points_per_element, 1u);
    EXPECT_EQ(as_decided.hourglass_modulus, HourglassModulus::elastic);
    EXPECT_EQ(as_decided.rayleigh.mass, 0.5);
    EXPECT_LT(as_decided.external_force.minCoeff(), 0.0) << "of the surcharge";
    decided.surcharge.value.clear();
    EXPECT_EQ(build_model(parsed, decided, mesh).external_force.norm(), 0.0);
}

/// Simple shear at a rate of 0.4 /s everywhere, tau = 20 kPa: beta G 0.4 over 20 kPa.
TEST(Monitors, ViscousShareIsThatOfDampingInStrainedSoil) {
    const scene::Scene parsed = parse(slope());
    const Mesh mesh = build_mesh(parsed, ".");
    Model model = build_model(parsed, decide_model(parsed), mesh);
    Motion motion = at_rest(model);
    for (Zone& zone : model.zones) zone.law = materials::LinearElastic{{2e7, 0.25}};
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
        motion.v[static_cast<Eigen::Index>(2 * n)] = 0.4 * mesh.nodes[n].y();
    for (State& point : motion.points) point.sigma = {-1e5, -1e5, -1e5, 2e4};
    for (Voigt& strain : motion.strain) strain = {0.0, 0.0, 0.0, 0.4};  // epsilon_q 0.23
    EXPECT_EQ(viscous_share(model, motion, 0.1), 0.0) << "undamped";
    model.rayleigh.stiffness = 5e-4;
    EXPECT_NEAR(viscous_share(model, motion, 0.1), 5e-4 * 8e6 * 0.4 / 2e4, 1e-9);
    EXPECT_EQ(viscous_share(model, motion, 0.3), 0.0) << "nothing is strained so far";
}

TEST(Plan, SaysWithWhichStageALawWithMemoryBeginsAndFromWhere) {
    json scene = slope();
    for (auto& [name, material] : scene["materials"].items())
        material["law"] = {{"type", "pm4sand"}, {"D_R", 0.35}, {"G_0", 476}, {"h_po", 2.7}};
    json& stages = scene["fem"]["stages"];
    stages = json::array({{{"type", "static"}, {"name", "gravity"}, {"laws", "elastic"}},
                          {{"type", "static"}, {"name", "sand"}, {"laws", "scene"}}});
    RunDecisions decided = decide_run(parse(scene));
    EXPECT_EQ(decided.memory.value, 1);
    EXPECT_EQ(decided.memory.line.use, process::Use::on);
    EXPECT_NE(decided.memory.line.reason.find("PM4Sand in "), std::string::npos);
    EXPECT_EQ(decided.memory_start.value, MemoryStart::at_rest_with_friction);
    EXPECT_EQ(decided.memory_start.line.use, process::Use::on);
    stages.erase(1);
    decided = decide_run(parse(scene));
    EXPECT_FALSE(decided.memory.value);
    EXPECT_EQ(decided.memory.line.use, process::Use::left_out);
    EXPECT_EQ(decided.memory_start.value, MemoryStart::as_they_are);
    EXPECT_FALSE(decide_run(parse(slope())).memory.value);
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
    const json line = telemetry_line(Reading{}, columns());
    for (const auto& [name, value] : line.items()) written.push_back(name);
    std::vector<std::string> kept;
    for (const Column& each : columns()) kept.emplace_back(each.name);
    EXPECT_EQ(kept, std::vector<std::string>(wanted.begin() + 1, wanted.end())) << "in this order";
    std::ranges::sort(wanted);
    std::ranges::sort(written);
    EXPECT_EQ(written, wanted);
}

TEST(Telemetry, LeavesOutWhatASceneDoesNotMeasure) {
    const auto has = [](const json& document, const char* name) {
        const auto made = columns_of(parse(document));
        return std::ranges::any_of(
            made, [&](const Column& each) { return each.name == std::string_view(name); });
    };
    const json dry = slope();
    for (const char* name : {"excess_pressure_avg", "r_u_max", "liquefaction_depth", "psi_avg"})
        EXPECT_FALSE(has(dry, name)) << name;
    EXPECT_TRUE(has(dry, "crest_displacement"));
    json wet = dry;
    wet["fem"]["water"] = {{"line", {{-1000, -1000}, {1000, -1000}}}};
    EXPECT_TRUE(has(wet, "excess_pressure_avg"));
    EXPECT_FALSE(has(wet, "r_u_max")) << "nothing is watched";
}

TEST(Telemetry, MeasuresTheLawOfTheFemAndNotTheOneTheRunoutTakes) {
    const auto scene = scene::read_scene(BREACH_ROOT "/workflows/scenes/static_lift.json");
    EXPECT_TRUE(std::ranges::any_of(columns_of(scene), [](const Column& each) {
        return each.name == std::string_view("past_peak_share");
    }));
}

TEST(Telemetry, HasStrengthOfNorSandWhereTheSceneAsksToLookAtIt) {
    const auto ratios = [](const scene::Scene& scene) {
        return std::ranges::count_if(columns_of(scene), [](const Column& each) {
            return std::string_view(each.name).starts_with("strength_ratio_");
        });
    };
    json dry = slope();
    dry["fem"]["strength_interval"] = 0.5;
    EXPECT_EQ(ratios(parse(dry)), 0) << "no soil of norsand";
    const std::string lift = BREACH_ROOT "/workflows/scenes/static_lift.json";
    EXPECT_EQ(ratios(scene::read_scene(lift)), 0) << "nobody looks";
    EXPECT_EQ(ratios(scene::read_scene(lift, {"/fem/strength_interval=0.5"})), 2);
}

TEST(Snapshot, IsNamedAfterItsTime) { EXPECT_EQ(snapshot_name(0.25), "snapshot_0.250000.vtkhdf"); }

}  // namespace
}  // namespace breach::fem
