// Counts before a run compared with those of the phases, and what estimates learn from runs.
// Seconds are measured, not tested: services/estimate/README.md.
#include "services/estimate/cost.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "services/estimate/counts.hpp"
#include "services/estimate/machine.hpp"

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

TEST(Counts, SoilFlowsLongerTheLessStrengthItKeeps) {
    const auto softened_to = [](double c_kPa, double phi) {
        const std::string softening = "/materials/slope_soil/law/softening/";
        return runout_duration(
            shipped("slope", {softening + "c_residual_kPa=" + std::to_string(c_kPa),
                              softening + "phi_residual_deg=" + std::to_string(phi)}));
    };
    EXPECT_GT(softened_to(1, 0), 2.0 * softened_to(2, 10));
    EXPECT_GT(softened_to(2, 10), softened_to(2, 20));
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
    EXPECT_GT(duration(flows, ""), 1.5 * duration(stays, ""));
    EXPECT_EQ(duration(flows, ""), duration(flows, softens));
    EXPECT_EQ(duration(stays, ""), duration(stays, softens));
}

TEST(Counts, WetNorSandFlowsWithAnyResidualStrength) {
    // Its profile has 30 degrees after softening; the transfer gives wet points s_u by state.
    scene::Scene scene = shipped("static_lift");
    const double flows = runout_duration(scene);
    scene.transfer->liquefied.reset();
    EXPECT_GT(flows, 1.5 * runout_duration(scene));
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
        const Range said = range_around(of(cost_of(scene), "lem_tool").cpu_seconds / slowness());
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
        EXPECT_GT(of(fine, phase).cpu_seconds, 1.5 * of(coarse, phase).cpu_seconds) << phase;
        EXPECT_GT(of(fine, phase).bytes, 1.5 * of(coarse, phase).bytes) << phase;
    }
    EXPECT_EQ(of(fine, "lem_tool").cpu_seconds, of(coarse, "lem_tool").cpu_seconds);
}

TEST(Cost, AMeshThatIsThereIsCounted) {
    const auto costs = cost_of(shipped("mochikoshi"), MeshCounts{5494, 5700});
    EXPECT_EQ(of(costs, "fem_solver").counts.at(0),
              (std::pair<std::string, double>{"elements", 5494}));
}

TEST(Cost, LearnsFromRunsOfItsOwnSceneOnly) {
    auto costs = cost_of(shipped("slope"));
    const PhaseCost before = of(costs, "fem_solver"), mpm = of(costs, "mpm_solver");
    learn(costs, "slope",
          {{"fem_solver", "slope", 3.0, 2.0},
           {"fem_solver", "slope", 4.0, 2.0},
           {"fem_solver", "slope", 50.0, 0.0},
           {"mpm_solver", "other", 100.0, 100.0}});
    const PhaseCost& after = of(costs, "fem_solver");
    EXPECT_NEAR(after.cpu_seconds, 4.0 * before.cpu_seconds, 1e-9);
    EXPECT_NEAR(after.bytes, 2.0 * before.bytes, 1e-3);
    EXPECT_EQ(after.basis, "by 3 earlier runs of this scene");
    EXPECT_EQ(of(costs, "mpm_solver").cpu_seconds, mpm.cpu_seconds);
    EXPECT_EQ(of(costs, "mpm_solver").basis, "by the scene alone");
}

TEST(Cost, AStudyRepeatsItsRunouts) {
    const auto costs = cost_of(shipped("slope"));
    const nlohmann::json scene = nlohmann::json::object();
    EXPECT_EQ(study_cost_of(costs, scene).tasks.at("mpm_solver"), 1.0);
    const StudyCost all =
        study_cost_of(costs, {{"scene", scene},
                              {"transfer_times", {{"from", 1}, {"to", 2}, {"step", 0.1}}},
                              {"variants", {scene, scene}},
                              {"draws", 3}});
    EXPECT_EQ(all.tasks.at("mpm_solver"), 66.0);
    EXPECT_NEAR(
        all.cpu_seconds,
        6 * (of(costs, "lem_tool").cpu_seconds + of(costs, "fem_solver").cpu_seconds) +
            66 * (of(costs, "transfer_tool").cpu_seconds + of(costs, "mpm_solver").cpu_seconds),
        1e-9 * all.cpu_seconds);
    EXPECT_EQ(lines_of(costs, all).size(), 5u);
}

TEST(Cost, WorkersShareTheTasksButNotTheLongestChain) {
    const auto costs = cost_of(shipped("slope"));
    const auto wall = [&](int runouts) {
        StudyCost all{.workers = 2};
        const double fem = all.add(of(costs, "fem_solver"), 0.0);
        for (int k = 0; k < runouts; ++k) all.add(of(costs, "mpm_solver"), fem);
        const auto range = as_json(costs, all)["wall_seconds"];
        return std::sqrt(range[0].get<double>() * range[1].get<double>());
    };
    const double fem = of(costs, "fem_solver").cpu_seconds,
                 mpm = of(costs, "mpm_solver").cpu_seconds;
    EXPECT_NEAR(wall(1), fem + mpm + 1.0 + 0.2, 1e-9);
    EXPECT_NEAR(wall(40), 0.5 * (fem + 40 * mpm) + 1.0 + 4.1, 1e-9);
}

TEST(Cost, SurvivesStudiesThatAreNone) {
    const auto costs = cost_of(shipped("slope"));
    for (const char* text :
         {"1", "[]", R"({"scene":1,"transfer_times":{"from":1},"variants":7,"draws":"x"})",
          R"({"scene":{},"transfer_times":{"from":1,"to":2,"step":0}})"})
        EXPECT_EQ(study_cost_of(costs, nlohmann::json::parse(text)).tasks.at("mpm_solver"), 1.0)
            << text;
}

}  // namespace
}  // namespace breach::estimate
