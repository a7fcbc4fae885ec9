#include "services/orchestrator/study/study.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "core/fault/fault.hpp"
#include "core/scene/file_paths.hpp"
#include "core/telemetry/columns.hpp"
#include "services/orchestrator/dispatch/verdict.hpp"
#include "services/orchestrator/study/graph.hpp"

namespace breach::orchestrator {
namespace {

using nlohmann::json;

json slope_study() {
    std::ifstream stream(BREACH_ROOT "/workflows/scenes/slope.json");
    return {{"format", "breachline-study/1"},
            {"name", "slope"},
            {"scene", json::parse(stream)},
            {"transfer_times", {0.5, 1.0}}};
}

std::vector<std::string> pointers_of_faults(const json& study) {
    std::vector<std::string> pointers;
    try {
        read_study(study.dump());
    } catch (const fault::BadInput& error) {
        for (const auto& each : error.faults()) pointers.push_back(each.pointer);
    }
    return pointers;
}

bool holds(const std::vector<std::string>& list, const std::string& wanted) {
    return std::ranges::find(list, wanted) != list.end();
}

TEST(Study, EvenRangeIncludesItsEndAndKeepsDecimalTimes) {
    json study = slope_study();
    study["transfer_times"] = {{"from", 0.1}, {"to", 0.5}, {"step", 0.1}};
    EXPECT_EQ(read_study(study.dump()).transfer_times,
              (std::vector<double>{0.1, 0.2, 0.3, 0.4, 0.5}));
}

TEST(Study, ListIsSorted) {
    json study = slope_study();
    study["transfer_times"] = {2.0, 0.25, 1.0};
    EXPECT_EQ(read_study(study.dump()).transfer_times, (std::vector<double>{0.25, 1.0, 2.0}));
}

TEST(Study, TimesThatShareASnapshotNameAreRefused) {
    json study = slope_study();
    study["transfer_times"] = {0.5, 0.5000000001};
    EXPECT_EQ(pointers_of_faults(study), std::vector<std::string>{"/transfer_times"});
}

TEST(Study, RangeThatRunsBackwardsOrHoldsTooManyTimesIsRefused) {
    json study = slope_study();
    study["transfer_times"] = {{"from", 1.0}, {"to", 0.5}, {"step", 0.1}};
    EXPECT_EQ(pointers_of_faults(study), std::vector<std::string>{"/transfer_times/to"});
    study["transfer_times"] = {{"from", 0.0}, {"to", 3.0}, {"step", 1e-5}};
    EXPECT_EQ(pointers_of_faults(study), std::vector<std::string>{"/transfer_times/step"});
    study["transfer_times"] = {{"from", 0.0}, {"to", 3.0}, {"step", 1e-300}};
    EXPECT_EQ(pointers_of_faults(study), std::vector<std::string>{"/transfer_times/step"});
}

TEST(Study, TransferAfterTheEndOfTheFemIsRefused) {
    json study = slope_study();
    study["transfer_times"] = {1.0, 3.5};  // the scene's dynamic stage lasts 3 s
    EXPECT_EQ(pointers_of_faults(study), std::vector<std::string>{"/transfer_times"});
}

TEST(Study, AllFaultsOfStudyAndSceneAreReportedAtOnceWithPointersIntoTheStudy) {
    json study = slope_study();
    study["nam"] = "typo";
    study["scene"]["materials"]["slope_soil"]["density"] = -1;
    study["scene"]["materials"]["base_soil"]["law"]["nu"] = 0.5;
    study["scene"].erase("mpm");
    const auto pointers = pointers_of_faults(study);
    EXPECT_TRUE(holds(pointers, "/nam"));
    EXPECT_TRUE(holds(pointers, "/scene/materials/slope_soil/density"));
    EXPECT_TRUE(holds(pointers, "/scene/materials/base_soil/law/nu"));
    EXPECT_TRUE(holds(pointers, "/scene/mpm"));
}

json whole(const std::string& name) {
    const std::filesystem::path file = BREACH_ROOT "/workflows/studies/" + name;
    std::ifstream stream(file);
    json study = json::parse(stream);
    const auto scene = file.parent_path() / study["scene"].get<std::string>();
    std::ifstream scene_stream(scene);
    study["scene"] = json::parse(scene_stream);
    scene::make_files_absolute(study["scene"], scene.parent_path());
    scene::make_override_files_absolute(study, scene.parent_path());
    return study;
}

TEST(Study, EveryShippedStudyPassesTheCheck) {
    std::size_t studies = 0;
    for (const auto& entry :
         std::filesystem::directory_iterator(BREACH_ROOT "/workflows/studies")) {
        if (entry.path().extension() != ".json") continue;
        const std::string name = entry.path().filename();
        ++studies;
        try {
            read_study(whole(name).dump());
        } catch (const fault::BadInput& error) {
            ADD_FAILURE() << name << ": " << error.what();
        }
    }
    EXPECT_GE(studies, 11u);
}

TEST(Study, FaultsOfStudySceneAndALaterVariantStandInOneList) {
    json study = whole("mochikoshi_quarter.json");
    study["nam"] = "typo";                                        // the study's schema
    study["transfer_times"] = {1.0, 99.0};                        // after the FEM's end
    study["scene"]["materials"]["tailings"]["density"] = -1;      // the scene's schema
    study["scene"]["fem"]["supports"][0]["from"] = {-40, -5.01};  // drawn beside the section
    study["scene"]["fem"]["supports"][0]["to"] = {280, -5.01};
    study["scene"]["mpm"]["runout"]["toe"] = {900, 0};  // outside the grid
    study["variants"] =
        json::array({{{"name", "sound"}, {"overrides", {"/mpm/duration=30"}}},
                     {{"name", "lost"}, {"overrides", {"/fem/motion/file=/nowhere/record.at2"}}}});
    const auto pointers = pointers_of_faults(study);
    EXPECT_TRUE(holds(pointers, "/nam"));
    EXPECT_TRUE(holds(pointers, "/transfer_times"));
    EXPECT_TRUE(holds(pointers, "/scene/materials/tailings/density"));
    EXPECT_TRUE(holds(pointers, "/scene/fem/supports/0"));
    EXPECT_TRUE(holds(pointers, "/scene/mpm/runout/toe"));
    EXPECT_TRUE(holds(pointers, "/variants/1/overrides"));
    EXPECT_FALSE(holds(pointers, "/variants/0/overrides")) << "the scene's own are not repeated";
}

TEST(Study, AVariantThatEndsBeforeItsTransfersIsRefused) {
    json study = slope_study();
    study["variants"] =
        json::array({{{"name", "long"}, {"overrides", json::array()}},
                     {{"name", "short"}, {"overrides", {"/fem/stages/1/duration=0.75"}}}});
    EXPECT_EQ(pointers_of_faults(study), std::vector<std::string>{"/variants/1/overrides"});
}

TEST(Study, ARelativeFileIsRefusedInOverridesAsWell) {
    json study = slope_study();
    study["variants"] =
        json::array({{{"name", "meshed"}, {"overrides", {"/fem/msh_file=meshes/slope.msh"}}}});
    EXPECT_EQ(pointers_of_faults(study), std::vector<std::string>{"/variants/0/overrides"});
}

TEST(Study, TriggersOnWhatTheRunDoesNotRecordAreRefused) {
    json study = slope_study();  // without water, and without stages of liquefaction
    study["triggers"] = json::array(
        {{{"kind", "criterion"}, {"when", "liquefaction_depth > 2"}},
         {{"kind", "window"}, {"lower", "crest_dx > 1"}, {"upper", "crest_dy > critical_depth"}}});
    EXPECT_EQ(pointers_of_faults(study),
              (std::vector<std::string>{"/triggers/0/when", "/triggers/1/upper"}));
}

TEST(Study, ASceneInPlaceOfAStudyIsNamedAsSuch) {
    EXPECT_EQ(pointers_of_faults(slope_study()["scene"]), std::vector<std::string>{"/format"});
}

TEST(Study, SceneByPathAndRelativeMeshFileAreRefused) {
    json study = slope_study();
    study["scene"] = "../scenes/slope.json";
    EXPECT_EQ(pointers_of_faults(study), std::vector<std::string>{"/scene"});
    study = slope_study();
    study["scene"]["fem"]["msh_file"] = "../../etc/mesh.msh";
    EXPECT_TRUE(holds(pointers_of_faults(study), "/scene/fem/msh_file"));
}

TEST(Study, OverridesEnterTheCompletedScene) {
    json study = slope_study();
    study["overrides"] = {"/materials/slope_soil/density=1900"};
    const Study read = read_study(study.dump());
    EXPECT_EQ(read.scene.at("materials").at("slope_soil").at("density"), 1900);
    EXPECT_EQ(read.scene.at("gravity"), 9.81);  // a default, now visible
    study["overrides"] = {"/materials/slope_soil/density=-1900"};
    EXPECT_EQ(pointers_of_faults(study),
              std::vector<std::string>{"/scene/materials/slope_soil/density"});
}

TEST(Graph, EachTransferTimeHasATransferFedByTheFemAndAnMpmFedByTheTransfer) {
    const Study study = read_study(slope_study().dump());
    const auto tasks = plan_tasks(study).tasks;
    ASSERT_EQ(tasks.size(), 6u);
    EXPECT_EQ(tasks[0].phase, "fem_solver");
    EXPECT_EQ(tasks[0].overrides, std::vector<std::string>{"/fem/snapshot_times=[0.5,1.0]"});
    EXPECT_EQ(tasks[1].phase, "lem_tool");
    EXPECT_FALSE(tasks[1].parent);
    for (const std::size_t i : {2u, 4u}) {
        EXPECT_EQ(tasks[i].phase, "transfer_tool");
        EXPECT_EQ(tasks[i].parent, 0u);
        EXPECT_EQ(tasks[i].release, Release::file_exists);
        EXPECT_EQ(tasks[i + 1].phase, "mpm_solver");
        EXPECT_EQ(tasks[i + 1].parent, i);
        EXPECT_EQ(tasks[i + 1].release, Release::parent_succeeded);
        EXPECT_EQ(tasks[i + 1].input, "particles.vtkhdf");
    }
    EXPECT_EQ(tasks[2].input, "snapshot_0.500000.vtkhdf");
}

TEST(Graph, SnapshotsOfTheSceneAreKeptAndStabilityCanBeLeftOut) {
    json study = slope_study();
    study["scene"]["fem"]["snapshot_times"] = {0.75, 1.0};
    study["stability"] = false;
    const auto tasks = plan_tasks(read_study(study.dump())).tasks;
    EXPECT_EQ(tasks[0].overrides, std::vector<std::string>{"/fem/snapshot_times=[0.5,0.75,1.0]"});
    EXPECT_EQ(tasks[1].phase, "transfer_tool");
}

TEST(Verdict, ReadsTheExitCodesAsTheContractSays) {
    const auto verdict = [](std::optional<int> code, std::optional<int> signal,
                            std::optional<StopReason> stopped = {}) {
        return judge({.attempt = "a", .exit_code = code, .signal = signal, .stopped = stopped});
    };
    EXPECT_EQ(verdict(0, {}), Verdict::well);
    for (const int code : {1, 2, 65, 70, 74, 127})
        EXPECT_EQ(verdict(code, {}), Verdict::badly) << code;
    EXPECT_EQ(verdict(75, {}), Verdict::retryable);
    EXPECT_EQ(verdict({}, 9), Verdict::retryable);
    EXPECT_EQ(verdict(143, {}),
              Verdict::retryable);  // somebody else's TERM: its checkpoint is there
    EXPECT_EQ(verdict(143, {}, StopReason::shutdown), Verdict::interrupted);
    EXPECT_EQ(verdict({}, 9, StopReason::shutdown), Verdict::interrupted);
    EXPECT_EQ(verdict(0, {}, StopReason::shutdown), Verdict::well);
    EXPECT_EQ(verdict(70, {}, StopReason::shutdown), Verdict::badly);
}

TEST(Triggers, MayAskForEveryColumnOfTheTelemetry) {
    for (const auto& table : {telemetry::fem_columns(), telemetry::run_columns()}) {
        for (const telemetry::Column& each : table) {
            json study = slope_study();
            study["triggers"] = {
                {{"kind", "criterion"}, {"when", std::string(each.name) + " > 0.5"}}};
            EXPECT_TRUE(pointers_of_faults(study).empty()) << each.name;
            EXPECT_NE(std::string(each.unit), "") << each.name;
            EXPECT_NE(std::string(each.meaning), "") << each.name;
        }
    }
}

}  // namespace
}  // namespace breach::orchestrator
