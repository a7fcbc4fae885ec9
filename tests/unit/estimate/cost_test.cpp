// Counts before a run compared with those of the phases, and what estimates learn from runs.
// Seconds are measured, not tested: services/estimate/README.md.
#include "services/estimate/cost.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "services/estimate/counts.hpp"

namespace breach::estimate {
namespace {

scene::Scene shipped(const std::string& name, const std::vector<std::string>& overrides = {}) {
    return scene::read_scene(BREACH_ROOT "/workflows/scenes/" + name + ".json", overrides);
}

double elements(const scene::Scene& scene) {
    double sum = 0.0;
    for (const double each : elements_of(scene)) sum += each;
    return sum;
}

const PhaseCost& of(const std::vector<PhaseCost>& costs, const std::string& phase) {
    for (const PhaseCost& each : costs)
        if (each.phase == phase) return each;
    throw std::runtime_error("no " + phase);
}

TEST(Counts, AreThoseOfThePhases) {
    EXPECT_EQ(elements(shipped("column")), 200.0);
    EXPECT_EQ(elements(shipped("slope")), 1215.0);
    // gmsh makes 7,078 elements of 1 m and 788 of 4 m of it
    EXPECT_NEAR(elements(shipped("mochikoshi")), 7078.0, 7078.0 / 4);
    EXPECT_NEAR(elements(shipped("mochikoshi", {"/section/element_size=4"})), 788.0, 788.0 / 4);
    EXPECT_EQ(steps_of(*shipped("slope").fem).steps, 281.0);
    EXPECT_EQ(points_of(shipped("slope"), 1215.0), 4860.0);
    EXPECT_NEAR(searches_of(shipped("slope")).surfaces, 18424.0, 1842.0);
    EXPECT_NEAR(runout_step(shipped("column")), 9.1 / 3168, 0.3 * 9.1 / 3168);
    EXPECT_NEAR(runout_step(shipped("slope")), 5.05 / 2541, 0.3 * 5.05 / 2541);
}

TEST(Counts, SoilWithoutFrictionFlowsLonger) {
    const double with = runout_duration(shipped("slope"));
    const double without = runout_duration(
        shipped("slope", {"/materials/slope_soil/law/softening/phi_residual_deg=0"}));
    EXPECT_GT(without, 5.0 * with);
    EXPECT_EQ(runout_duration(shipped("slope", {"/mpm/duration=3"})), 3.0);
}

TEST(Counts, SoilThatLiquefiesHasItsResidualStrengthFromTheStart) {
    const auto duration = [](const std::string& residual, const std::string& softening) {
        const std::string peak = R"({"peak":{"type":"effective","phi_deg":30},"residual":)";
        // Sand instead of NorSand: liquefies by pore pressure, with the profile's strengths.
        return runout_duration(shipped(
            "static_lift",
            {R"(/materials/tailings/law={"type":"mohr_coulomb","E_MPa":30,"nu":0.3,"c_kPa":1,"phi_deg":30})",
             "/lem/undrained=[]", R"(/transfer/window={"lower":"epsilon_q_max > 0.1"})",
             "/materials/flowing_tailings/strength=" + peak + residual + softening + "}"}));
    };
    const std::string flows = R"({"type":"undrained_ratio","ratio":0.05,"minimum_kPa":0.5})";
    const std::string stays = R"({"type":"effective","phi_deg":25})";
    const std::string softens = R"(,"softening":{"epsilon_q_start":0.02,"epsilon_q_end":0.1})";
    EXPECT_GT(duration(flows, ""), 5.0 * duration(stays, ""));
    EXPECT_EQ(duration(flows, ""), duration(flows, softens));
    EXPECT_EQ(duration(stays, ""), duration(stays, softens));
}

TEST(Counts, WetNorSandFlowsWithAnyResidualStrength) {
    // Its profile has 30 degrees after softening; the transfer gives wet points s_u by state.
    scene::Scene scene = shipped("static_lift");
    const double flows = runout_duration(scene);
    scene.transfer->liquefied.reset();
    EXPECT_GT(flows, 5.0 * runout_duration(scene));
}

TEST(Counts, VariationsAndSurfacesOfStraightPiecesAreSearchedFor) {
    const auto searches = [](const std::string& more) {
        return searches_of(more.empty() ? shipped("slope") : shipped("slope", {more}));
    };
    const double alone = searches("").stages;
    const auto samples = [](const std::string& surface) {
        return R"(/lem/probability={"samples":20,"surface":")" + surface +
               R"(","variables":[{"parameter":"cohesion","of":"slope_soil","coefficient_of_variation":0.2}]})";
    };
    EXPECT_EQ(searches(samples("searched")).stages, alone + 21.0);
    EXPECT_NEAR(searches(samples("fixed")).stages, alone + 1.0, 0.01);
    EXPECT_EQ(searches("").polylines, 0.0);
    // lem_tool analysed 7,336 and 16,784 of them
    EXPECT_NEAR(searches(R"(/lem/non_circular={"vertices":13})").polylines, 7336.0, 734.0);
    EXPECT_NEAR(searches(R"(/lem/non_circular={"vertices":60})").polylines, 16784.0, 1678.0);
    // of mochikoshi with its five layers 49,904
    EXPECT_NEAR(
        searches_of(shipped("mochikoshi", {R"(/lem/non_circular={"vertices":13})"})).polylines,
        49904.0, 0.1 * 49904.0);
}

TEST(Counts, CracksThinWeakLayersAndBoundsAreSearchedFor) {
    const double alone = searches_of(shipped("slope")).slices;
    EXPECT_GT(searches_of(shipped("slope", {R"(/lem/tension_crack={"depth":2})"})).slices,
              3.0 * alone);
    const scene::Scene seam =
        scene::read_scene(BREACH_ROOT "/workflows/verification/catalogue/lem/acads_4.json");
    scene::Scene sound = seam;
    for (scene::Material& each : sound.materials) each = sound.materials.front();
    EXPECT_GT(searches_of(seam).slices, 1.5 * searches_of(sound).slices);
}

TEST(Cost, OfLimitEquilibriumIsWithinTwoOfWhatItTook) {
    // CPU seconds on 2026-11-26, on a loaded machine with two cores, minimum of two or three runs.
    const auto expect = [](const scene::Scene& scene, double measured) {
        const Range said = of(cost_of(scene), "lem_tool").cpu_seconds;
        std::printf("    %-22s took %.3f CPU s, said %.3f to %.3f\n", scene.name.c_str(), measured,
                    said.low, said.high);
        EXPECT_GT(measured, said.low) << scene.name;
        EXPECT_LT(measured, said.high) << scene.name;
    };
    expect(shipped("slope"), 0.091);
    expect(shipped("flow_slope"), 0.085);
    expect(shipped("static_lift"), 0.176);
    expect(shipped("static_phreatic_rise"), 0.166);
    expect(shipped("static_toe_cut"), 0.131);
    expect(shipped("mochikoshi"), 1.131);
    expect(shipped("merriespruit"), 1.645);
    expect(shipped("slope", {R"(/lem/tension_crack={"depth":2})"}), 0.562);
    expect(shipped("slope", {R"(/lem/non_circular={"vertices":13})"}), 0.494);
    expect(scene::read_scene(BREACH_ROOT "/workflows/verification/catalogue/lem/acads_4.json"),
           0.587);
}

TEST(Cost, HasThePhasesOfTheScene) {
    std::vector<std::string> phases;
    for (const PhaseCost& each : cost_of(shipped("mochikoshi_runout")))
        phases.push_back(each.phase);
    EXPECT_EQ(phases, std::vector<std::string>{"mpm_solver"});
    EXPECT_EQ(cost_of(shipped("mochikoshi")).size(), 4u);
}

TEST(Cost, GrowsWithTheWork) {
    const auto coarse = cost_of(shipped("slope"));
    const auto fine = cost_of(shipped("slope", {"/section/regions/0/mesh/divisions=[180,12]",
                                                "/section/regions/1/mesh/divisions=[90,30]"}));
    for (const char* phase : {"fem_solver", "transfer_tool", "mpm_solver"}) {
        EXPECT_GT(of(fine, phase).cpu_seconds.low, 1.5 * of(coarse, phase).cpu_seconds.low)
            << phase;
        EXPECT_GT(of(fine, phase).bytes.low, 1.5 * of(coarse, phase).bytes.low) << phase;
    }
    EXPECT_EQ(of(fine, "lem_tool").cpu_seconds.low, of(coarse, "lem_tool").cpu_seconds.low);
}

TEST(Cost, AMeshThatIsThereIsCounted) {
    const auto costs = cost_of(shipped("mochikoshi"), MeshCounts{5494, 5700});
    EXPECT_EQ(of(costs, "fem_solver").counts.at(0),
              (std::pair<std::string, double>{"elements", 5494}));
}

TEST(Cost, LearnsFromRunsOfItsOwnSceneFirst) {
    auto costs = cost_of(shipped("slope"));
    const PhaseCost before = of(costs, "fem_solver");
    learn(costs, "slope",
          {{"fem_solver", "slope", 3.0, 2.0},
           {"fem_solver", "slope", 4.0, 2.0},
           {"fem_solver", "other", 100.0, 100.0}});
    const PhaseCost& after = of(costs, "fem_solver");
    EXPECT_NEAR(after.cpu_seconds.low, before.cpu_seconds.middle() * 3.0 / 1.25, 1e-9);
    EXPECT_NEAR(after.cpu_seconds.high, before.cpu_seconds.middle() * 4.0 * 1.25, 1e-9);
    EXPECT_EQ(after.basis, "by 2 earlier runs of this scene");
    EXPECT_EQ(of(costs, "mpm_solver").basis, "by the scene alone");
    learn(costs, "slope", {{"mpm_solver", "other", 1.0, 1.0}});
    EXPECT_EQ(of(costs, "mpm_solver").basis, "by 1 earlier run of other scenes");
}

TEST(Cost, ManyRunoutsCostTheirMean) {
    // A sweep's first runouts stop, its last one flows: 1 and 19 times the estimate from the scene
    // alone.
    auto costs = cost_of(shipped("slope"));
    const double middle = of(costs, "mpm_solver").cpu_seconds.middle();
    learn(costs, "slope", {{"mpm_solver", "slope", 1.0, 1.0}, {"mpm_solver", "slope", 19.0, 1.0}});
    const PhaseCost& mpm = of(costs, "mpm_solver");
    EXPECT_NEAR(mpm.mean_cpu_seconds.low, 10.0 * middle / 1.5, 1e-9);
    EXPECT_NEAR(mpm.mean_cpu_seconds.high, 10.0 * middle * 1.5, 1e-9);
    const auto sum = [&](double runouts) {
        return as_json(costs, {runouts, 1.0})["cpu_seconds"][1].get<double>();
    };
    EXPECT_NEAR(sum(5.0) - sum(4.0),
                mpm.mean_cpu_seconds.high + of(costs, "transfer_tool").cpu_seconds.high, 1e-9);
}

TEST(Cost, AStudyRepeatsItsRunouts) {
    const nlohmann::json scene = nlohmann::json::object();
    EXPECT_EQ(repeats_of(scene).runouts, 1.0);
    const Repeats repeats = repeats_of({{"scene", scene},
                                        {"transfer_times", {{"from", 1}, {"to", 2}, {"step", 0.1}}},
                                        {"variants", {scene, scene}},
                                        {"draws", 3}});
    EXPECT_EQ(repeats.runouts, 66.0);
    const auto costs = cost_of(shipped("slope"));
    const auto sum = as_json(costs, {4.0, 1.0});
    const PhaseCost &lem = of(costs, "lem_tool"), &fem = of(costs, "fem_solver"),
                    &transfer = of(costs, "transfer_tool"), &mpm = of(costs, "mpm_solver");
    EXPECT_NEAR(sum["cpu_seconds"][0].get<double>(),
                lem.cpu_seconds.low + fem.cpu_seconds.low +
                    4 * (transfer.cpu_seconds.low + mpm.cpu_seconds.low),
                1e-9);
    EXPECT_EQ(lines_of(costs, {4.0, 1.0}).size(), 5u);
}

TEST(Cost, SurvivesStudiesThatAreNone) {
    for (const char* text :
         {"1", "[]", R"({"scene":1,"transfer_times":{"from":1},"variants":7,"draws":"x"})",
          R"({"scene":{},"transfer_times":{"from":1,"to":2,"step":0}})"})
        EXPECT_EQ(repeats_of(nlohmann::json::parse(text)).runouts, 1.0) << text;
}

}  // namespace
}  // namespace breach::estimate
