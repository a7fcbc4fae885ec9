#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "core/command/command.hpp"
#include "core/fault/fault.hpp"
#include "core/phases/reads.hpp"
#include "core/scene/file_paths.hpp"
#include "core/telemetry/columns.hpp"
#include "services/orchestrator/dispatch/ending.hpp"
#include "services/orchestrator/programs/numerics.hpp"
#include "services/orchestrator/records/firing_plan.hpp"
#include "services/orchestrator/records/trigger.hpp"
#include "services/orchestrator/study/graph.hpp"
#include "services/orchestrator/study/read_study.hpp"
#include "services/orchestrator/study/recipe.hpp"
#include "tests/folder.hpp"

namespace breach::orchestrator::study_test {
namespace {

using nlohmann::json;

const Numerics numerics{{"lem_tool", 1},
                        {"fem_solver", 1},
                        {"post_seismic", 1},
                        {"transfer_tool", 1},
                        {"mpm_solver", 1}};

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
    const auto remedy = [](const json& asked) {
        try {
            read_study(asked.dump());
        } catch (const fault::BadInput& error) {
            return error.faults().at(0).remedy;
        }
        return std::string();
    };
    study["transfer_times"] = {2000};
    EXPECT_EQ(remedy(study), "times are in seconds: for 2000 ms, write 2");
    study["transfer_times"] = {1.0};
    study["scene"]["fem"]["snapshot_times"] = {2000};
    EXPECT_EQ(remedy(study), "times are in seconds: for 2000 ms, write 2");
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

TEST(Study, OverridesThatContradictOrRepeatEachOtherAndLateCriteriaAreWarnedOf) {
    json study = slope_study();
    study["overrides"] = {"/mpm/cfl=0.5", "/mpm/cfl=0.3"};
    study["variants"] = json::array({{{"name", "a"}, {"overrides", {"/mpm/duration=30"}}},
                                     {{"name", "b"}, {"overrides", {"/mpm/duration=30"}}}});
    study["triggers"] =
        json::array({{{"kind", "criterion"}, {"name", "never"}, {"when", "time > 100"}},
                     {{"kind", "criterion"}, {"name", "ever"}, {"when", "time > 0.5"}}});
    std::string told;
    for (const auto& each : read_study(study.dump()).warnings)
        told += each.code + " " + each.pointer + ": " + each.message + "\n";
    for (const char* each :
         {"overridden_twice /overrides: sets /mpm/cfl to 0.5 and to 0.3: the last value holds",
          "equal_variants /variants/1/overrides: variants \"a\" and \"b\" have the same overrides",
          "late_criterion /triggers/0/when: \"time > 100\" is never true: the FEM ends at "})
        EXPECT_NE(told.find(each), std::string::npos) << each << "\n" << told;
    EXPECT_EQ(told.find("/triggers/1"), std::string::npos) << told;
}

TEST(Study, OverridesOfAMaterialOrStageThatIsNotThereAreRefusedInOneFault) {
    json study = slope_study();
    study["overrides"] = {"/materials/slope_soli/law/c_kPa=5"};
    EXPECT_EQ(pointers_of_faults(study),
              std::vector<std::string>{"/scene/materials/slope_soli/law/c_kPa"});
    study["overrides"] = {"/fem/stages/7/duration=2"};
    EXPECT_EQ(pointers_of_faults(study), std::vector<std::string>{"/scene/fem/stages/7/duration"});
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
         {{"kind", "window"}, {"lower", "crest_dx > 1"}, {"upper", "crest_dy > critical_depth"}},
         {{"kind", "criterion"}, {"when", "past_peak_share > 0.05 or excess_pressure_avg > 1"}}});
    EXPECT_EQ(pointers_of_faults(study),
              (std::vector<std::string>{"/triggers/0/when", "/triggers/1/upper", "/triggers/2/when",
                                        "/triggers/2/when"}));
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
    const auto tasks = plan_tasks(study, numerics).tasks;
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

/// Without a FEM.
json static_study() {
    json study = slope_study();
    study.erase("transfer_times");
    study["scene"].erase("fem");
    return study;
}

std::vector<std::string> labels_of(const json& study) {
    std::vector<std::string> labels;
    for (const TaskPlan& each : plan_tasks(read_study(study.dump()), numerics).tasks)
        labels.push_back(each.label);
    return labels;
}

TEST(StaticScene, HasItsRunoutAndItsStabilityForEveryVariantAndNothingWaits) {
    json study = static_study();
    EXPECT_EQ(labels_of(study), (std::vector<std::string>{"mpm", "lem"}));
    study["variants"] = {
        {{"name", "soft"}, {"overrides", {"/mpm/cfl=0.3"}}},
        {{"name", "light"}, {"overrides", {"/materials/slope_soil/density=1700"}}}};
    EXPECT_EQ(labels_of(study),
              (std::vector<std::string>{"mpm_soft", "lem_soft", "mpm_light", "lem_light"}));
    for (const TaskPlan& each : plan_tasks(read_study(study.dump()), numerics).tasks) {
        EXPECT_EQ(each.release, Release::at_once);
        EXPECT_FALSE(each.transfer_time);
    }
    study["stability"] = false;
    EXPECT_EQ(labels_of(study), (std::vector<std::string>{"mpm_soft", "mpm_light"}));
    study["variants"] = json::array();
    study["draws"] = 2;
    const Study drawn = read_study(study.dump());
    ASSERT_EQ(drawn.variants.size(), 2u);
    EXPECT_TRUE(drawn.variants[1].overrides.back().starts_with("/mpm/fill_shift="));
}

TEST(StaticScene, WithoutPointsIsItsStabilityAlone) {
    json study = static_study();
    study["scene"].erase("mpm");
    EXPECT_EQ(labels_of(study), (std::vector<std::string>{"lem"}));
    study["draws"] = 2;
    EXPECT_EQ(pointers_of_faults(study), std::vector<std::string>{"/draws"});
    study.erase("draws");
    study["stability"] = false;
    EXPECT_EQ(pointers_of_faults(study), std::vector<std::string>{"/stability"});
}

TEST(StaticScene, HasNothingToTransferAndNothingToWatch) {
    json study = static_study();
    study["transfer_times"] = {0.5};
    study["triggers"] = {{{"kind", "manual"}}};
    EXPECT_EQ(pointers_of_faults(study),
              (std::vector<std::string>{"/transfer_times", "/triggers"}));
}

TEST(Graph, SnapshotsOfTheSceneAreKeptAndStabilityCanBeLeftOut) {
    json study = slope_study();
    study["scene"]["fem"]["snapshot_times"] = {0.75, 1.0};
    study["stability"] = false;
    const auto tasks = plan_tasks(read_study(study.dump()), numerics).tasks;
    EXPECT_EQ(tasks[0].overrides, std::vector<std::string>{"/fem/snapshot_times=[0.5,0.75,1.0]"});
    EXPECT_EQ(tasks[1].phase, "transfer_tool");
}

json study_with_variants() {
    json study = slope_study();
    // One changes what the FEM reads, the other only the MPM: it shares the first one's FEM.
    study["variants"] = {
        {{"name", "as_is"}, {"overrides", json::array()}},
        {{"name", "short"}, {"overrides", {"/mpm/duration=1"}}},
        {{"name", "light"}, {"overrides", {"/materials/slope_soil/density=1700"}}}};
    return study;
}

TEST(Graph, EveryVariantHasAStabilityAnalysisThatItsRowsKnow) {
    const auto analyses = [](const json& study) {
        std::vector<std::string> labels;
        for (const TaskPlan& each : plan_tasks(read_study(study.dump()), numerics).tasks)
            if (each.phase == "lem_tool") labels.push_back(each.label);
        return labels;
    };
    json study = study_with_variants();
    EXPECT_EQ(analyses(study), (std::vector<std::string>{"lem_as_is", "lem_short", "lem_light"}));
    study["variants"].erase(2);
    EXPECT_EQ(analyses(study), std::vector<std::string>{"lem"}) << "one serves all";
}

TEST(Graph, VariantsShareAFemThatATriggerWatchesForItsCriticalDepthOnlyWhereTheDepthIsTheSame) {
    json study = slope_study();
    study["scene"]["lem"]["pore_pressure_ratios"] =
        json::array({{{"region", "slope"}, {"r_u", 0.01}}});
    study["scene"]["lem"]["liquefaction"] =
        json::array({{{"region", "slope"}, {"residual_strength_kPa", 10}}});
    study["variants"] = {
        {{"name", "firm"}, {"overrides", json::array()}},
        {{"name", "weak"}, {"overrides", {"/lem/liquefaction/0/residual_strength_kPa=5"}}},
        {{"name", "short"}, {"overrides", {"/mpm/duration=1"}}}};
    const auto labels = [&](const std::string& when) {
        study["triggers"] = json::array({{{"kind", "criterion"}, {"when", when}}});
        const TaskGraph graph = plan_tasks(read_study(study.dump()), numerics);
        std::vector<std::string> found;
        for (const TaskPlan& each : graph.tasks)
            if (each.phase == "fem_solver") found.push_back(each.label);
        std::vector<std::string> of_triggers;
        for (const TaskPlan& each : graph.one_more_transfer)
            if (each.phase == "fem_solver") of_triggers.push_back(each.label);
        EXPECT_EQ(of_triggers, found) << "what fires finds its FEM by its label";
        return found;
    };
    const std::vector<std::string> one{"fem"};
    EXPECT_EQ(labels("crest_displacement > 1"), one);
    EXPECT_EQ(labels("crest_displacement > critical_depth"),
              (std::vector<std::string>{"fem_firm", "fem_weak"}));
    study["variants"].erase(1);
    EXPECT_EQ(labels("crest_displacement > critical_depth"), one) << "one analysis serves both";
}

/// Everything in a task's row.
std::vector<std::string> rows_of(const std::vector<TaskPlan>& tasks) {
    std::vector<std::string> rows;
    for (TaskPlan task : tasks) {
        if (!task.transfer_time) continue;
        const std::string parent = tasks[*task.parent].label;
        task.parent.reset();  // places differ between the lists
        rows.push_back(json(task).dump() + " of " + parent);
    }
    std::ranges::sort(rows);
    return rows;
}

TEST(Graph, OneMoreTransferIsTheTasksThatTheStudyWouldHaveMadeForThatTime) {
    json study = study_with_variants();
    study["transfer_times"] = {0.5};
    const TaskGraph graph = plan_tasks(read_study(study.dump()), numerics);
    // Stored as text in the database and read again.
    std::vector<TaskPlan> added =
        json::parse(json(graph.one_more_transfer).dump()).get<std::vector<TaskPlan>>();
    for (TaskPlan& each : added)
        if (each.parent) each = at_time(std::move(each), 0.5);
    EXPECT_EQ(rows_of(added), rows_of(graph.tasks));
    EXPECT_EQ(rows_of(added).size(), 5u);  // two transfers, three runouts
}

TEST(Recipe, FollowsTheNumericsThatThePhaseSays) {
    const json scene = read_study(slope_study().dump()).scene;
    const Recipe recipe = recipe_of("mpm_solver", scene, 3);
    EXPECT_EQ(recipe.hash, recipe_of("mpm_solver", scene, 3).hash);
    EXPECT_NE(recipe.hash, recipe_of("mpm_solver", scene, 4).hash);
    EXPECT_EQ(recipe.cache_version, 3);
}

/// The recipe includes what a phase reads outside its part of the scene.
TEST(Recipe, KnowsTheGroundThatTheMpmFillsTheProfileThatAnotherNamesAndTheWaterOfStrengths) {
    json chain = read_study(slope_study().dump()).scene;
    json filled = chain;
    filled.erase("fem");
    const auto differs = [](const char* phase, const json& scene, const char* at,
                            const json& value) {
        json other = scene;
        other[json::json_pointer(at)] = value;
        return recipe_of(phase, scene, 1).hash != recipe_of(phase, other, 1).hash;
    };
    const json ring{{0, 0}, {10, 0}, {10, 8}, {0, 8}, {0, 0}};
    EXPECT_TRUE(differs("mpm_solver", filled, "/section/regions/0/polygon", ring));
    EXPECT_FALSE(differs("mpm_solver", chain, "/section/regions/0/polygon", ring))
        << "the particles have it";
    const json water{{"line", {{0, 1}, {60, 1}}}};
    EXPECT_FALSE(differs("transfer_tool", chain, "/lem/water", water)) << "no strength goes by it";
    const std::string used = chain.at("/section/regions/0/material"_json_pointer);
    for (json* each : {&filled, &chain})
        (*each)["materials"][used]["strength"] = {{"peak", {{"ratio", 0.3}}}};
    EXPECT_TRUE(differs("mpm_solver", filled, "/lem/water", water));
    EXPECT_TRUE(differs("transfer_tool", chain, "/lem/water", water));
    EXPECT_FALSE(differs("fem_solver", chain, "/lem/water", water));
    json like = chain;
    like["materials"][used]["strength"] = {{"like", "profile"}};
    like["materials"]["profile"] = {{"strength", {{"peak", {{"ratio", 0.3}}}}}};
    for (const char* phase : {"lem_tool", "fem_solver"})
        EXPECT_TRUE(differs(phase, like, "/materials/profile/strength/peak/ratio", 0.15)) << phase;
}

/// Otherwise a result could depend on an entry outside its cache key.
TEST(Recipe, HasEveryEntryThatAPhaseOrOneBeforeItCanSee) {
    const json scene = read_study(slope_study().dump()).scene;
    constexpr std::size_t post_seismic = 2, transfer = 3;
    const auto keys = [](std::size_t phase, const json& of) {
        std::string text;
        for (std::size_t i = phase < 2 ? phase : 1; i <= phase; ++i)
            if (i == phase || i != post_seismic)  // nothing comes after it
                text += phases::part_read_by(phases::all[i], of).dump();
        return text;
    };
    const json flat = scene.flatten();
    for (std::size_t i = 0; i < phases::all.size(); ++i) {
        int unseen = 0;
        for (const auto& [pointer, value] : flat.items()) {
            if (pointer == "/name" || pointer == "/title" || pointer == "/format") continue;
            if (pointer.ends_with("/material")) continue;  // names another entry
            const bool keeps_the_grid_alone = i == post_seismic || i == transfer;
            if (keeps_the_grid_alone && pointer.starts_with("/mpm/")) continue;
            json other = scene;
            other[json::json_pointer(pointer)] = "another";
            if (keys(i, scene) != keys(i, other)) continue;
            ++unseen;
            EXPECT_EQ(phases::scene_known_to(phases::all[i], scene),
                      phases::scene_known_to(phases::all[i], other))
                << phases::all[i].program << " sees " << pointer;
        }
        EXPECT_GT(unseen, 0) << phases::all[i].program;
    }
}

/// A folder with four programs that give these answers to --version.
class NumericsOfPhases : public ::testing::Test {
  protected:
    void SetUp() override {
        for (const auto& [phase, number] : numerics)
            write(phase, "echo " + phase + " 0.1.0; echo numerics " + std::to_string(number));
    }
    void write(const std::string& phase, const std::string& what) const {
        std::ofstream(bin_ / phase) << "#!/bin/sh\n" << what << "\n";
        std::filesystem::permissions(bin_ / phase, std::filesystem::perms::owner_all);
    }
    std::string complaint() const {
        try {
            numerics_of_phases(bin_);
        } catch (const fault::IoError& error) {
            return error.what();
        }
        return {};
    }
    const test::Folder folder_;
    const std::filesystem::path& bin_ = folder_.path();
};

TEST_F(NumericsOfPhases, AreWhatTheProgramsSay) { EXPECT_EQ(numerics_of_phases(bin_), numerics); }

TEST_F(NumericsOfPhases, ProgramThatIsMissingOrOldIsNamedWithARemedy) {
    write("mpm_solver", "echo mpm_solver 0.1.0");
    EXPECT_NE(complaint().find((bin_ / "mpm_solver").string() + " --version does not say"),
              std::string::npos)
        << complaint();
    write("mpm_solver", "echo numerics 3; exit 1");
    EXPECT_NE(complaint().find("does not say"), std::string::npos);
    std::filesystem::remove(bin_ / "mpm_solver");
    EXPECT_NE(complaint().find("there is no such program"), std::string::npos);
    EXPECT_NE(complaint().find("--bin"), std::string::npos);
}

TEST(Command, ThatClosesItsOutputAndGoesOnIsEnded) {
    const command::Result result =
        command::run({"sh", "-c", "exec >&- 2>&-; sleep 3600"}, "", std::chrono::milliseconds(300));
    EXPECT_FALSE(result.exit_code);
}

TEST(Ending, ReadsTheExitCodesAsTheContractSays) {
    const auto ending = [](std::optional<int> code, std::optional<int> signal,
                           std::optional<StopReason> stopped = {}) {
        return ending_of({.attempt = "a", .exit_code = code, .signal = signal, .stopped = stopped},
                         false);
    };
    EXPECT_EQ(ending(0, {}), Ending::well);
    for (const int code : {1, 2, 65, 70, 74, 127})
        EXPECT_EQ(ending(code, {}), Ending::badly) << code;
    EXPECT_EQ(ending_of({.attempt = "a", .exit_code = 65, .signal = {}, .stopped = {}}, true),
              Ending::retryable);  // starts again: its checkpoint was refused
    EXPECT_EQ(ending(75, {}), Ending::retryable);
    EXPECT_EQ(ending({}, 9), Ending::retryable);
    EXPECT_EQ(ending(143, {}),
              Ending::retryable);  // TERM from elsewhere: its checkpoint exists
    EXPECT_EQ(ending(143, {}, StopReason::shutdown), Ending::interrupted);
    EXPECT_EQ(ending({}, 9, StopReason::shutdown), Ending::interrupted);
    EXPECT_EQ(ending(0, {}, StopReason::shutdown), Ending::well);
    // Time limit: a run with a checkpoint continues; one that had to be killed would only start
    // again.
    EXPECT_EQ(ending(143, {}, StopReason::signal), Ending::interrupted);
    EXPECT_EQ(ending({}, 9, StopReason::signal), Ending::retryable);
    EXPECT_EQ(ending({}, 15, StopReason::signal), Ending::retryable);
    EXPECT_EQ(ending(70, {}, StopReason::shutdown), Ending::badly);
}

TEST(Triggers, MayAskForEveryColumnOfTheTelemetry) {
    for (const auto& table : {telemetry::fem_columns(), telemetry::run_columns()}) {
        for (const telemetry::Column& each : table) {
            // Without a study, which would check whether its scene measures the column.
            json entries = json::array();
            entries.push_back({{"kind", "criterion"}, {"when", std::string(each.name) + " > 0.5"}});
            std::vector<fault::Fault> faults;
            check_triggers(entries, 10.0, "/triggers", faults);
            EXPECT_TRUE(faults.empty()) << each.name;
            EXPECT_NE(std::string(each.unit), "") << each.name;
            EXPECT_NE(std::string(each.meaning), "") << each.name;
        }
    }
}

TEST(Study, PostSeismicStabilityWaitsForItsFemAndReadsAllSnapshots) {
    json study = slope_study();
    study["transfer_times"] = {1, 2};
    study["variants"] = {{{"name", "one"}, {"overrides", json::array()}},
                         {{"name", "two"}, {"overrides", {"/mpm/cfl=0.3"}}}};
    const auto planned = [&] { return plan_tasks(read_study(study.dump()), numerics).tasks; };
    const auto of = [](const std::vector<TaskPlan>& tasks, const std::string& phase) {
        std::vector<TaskPlan> found;
        std::ranges::copy_if(tasks, std::back_inserter(found),
                             [&](const TaskPlan& each) { return each.phase == phase; });
        return found;
    };
    EXPECT_TRUE(of(planned(), "post_seismic").empty()) << "nobody has asked for it";
    study["post_seismic"] = true;
    auto tasks = planned();
    ASSERT_EQ(of(tasks, "post_seismic").size(), 1u) << "both variants have the same";
    const TaskPlan post = of(tasks, "post_seismic").front();
    EXPECT_EQ(tasks[*post.parent].phase, "fem_solver");
    EXPECT_EQ(post.input, "frames.vtkhdf.series");
    EXPECT_EQ(post.label, "postseismic");
    study["variants"][1]["overrides"] = {"/lem/search/minimum_depth=2"};
    tasks = planned();
    EXPECT_EQ(of(tasks, "post_seismic").size(), 2u) << "other surfaces";
    EXPECT_EQ(of(tasks, "fem_solver").size(), 1u);
    study["scene"].erase("lem");
    EXPECT_THROW(read_study(study.dump()), fault::BadInput);
}

}  // namespace
}  // namespace breach::orchestrator::study_test
