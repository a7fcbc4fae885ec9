// The entries "accuracy" and "draws" of a study: their tasks, and refusals.
#include <gtest/gtest.h>

#include "services/orchestrator/accuracy/measured.hpp"
#include "services/orchestrator/study/read_study.hpp"
#include "tests/unit/orchestrator/column_study.hpp"

namespace breach::orchestrator::accuracy_study_test {
namespace {

using nlohmann::json;

json accuracy_entry() {
    return {{"quantity", "runout"},
            {"ladders",
             {{{"name", "cells"}, {"steps", {{"/mpm/cell_size=4"}, {"=2"}, {"=1"}}}},
              {{"name", "points"},
               {"steps", {{"/transfer/points_per_cell=4"}, {"=9"}, {"=16"}}},
               {"sizes", {0.5, 0.3333, 0.25}}}}}};
}

json study_with(const json& accuracy) {
    return {{"format", "breachline-study/1"},
            {"name", "error"},
            {"scene", column_scene()},
            {"transfer_times", {0.4}},
            {"accuracy", accuracy}};
}

TEST(AccuracyStudy, EveryRungIsAnOrdinaryVariant) {
    const Study study = read_study(study_with(accuracy_entry()).dump());
    ASSERT_EQ(study.variants.size(), 6u);
    EXPECT_EQ(study.variants[1].name, "cells_2");
    EXPECT_EQ(study.variants[1].scene["mpm"]["cell_size"], 2);
    EXPECT_EQ(study.variants[4].overrides, std::vector<std::string>{"/transfer/points_per_cell=9"});
    EXPECT_EQ(study.document["variants"][3]["made_by"], "accuracy");
    const TaskGraph graph = plan_tasks(study, numerics);
    EXPECT_EQ(count(graph, "fem_solver"), 1u) << "no rung changes the FEM";
    EXPECT_EQ(count(graph, "mpm_solver"), 6u);
    EXPECT_EQ(count(graph, "lem_tool"), 0u);
}

TEST(AccuracyStudy, DrawsMoveTheLatticeAndTheFirstDoesNot) {
    json accuracy = accuracy_entry();
    accuracy["draws"] = 3;
    const Study study = read_study(study_with(accuracy).dump());
    ASSERT_EQ(study.variants.size(), 18u);
    EXPECT_EQ(study.variants[2].name, "cells_1_d3");
    const json& unmoved = study.variants[0].scene["transfer"]["point_shift"];
    EXPECT_EQ(unmoved, json({0, 0}));
    EXPECT_NE(study.variants[1].scene["transfer"]["point_shift"], unmoved);
    EXPECT_NE(study.variants[1].scene["transfer"]["point_shift"],
              study.variants[2].scene["transfer"]["point_shift"]);
    EXPECT_EQ(study.variants[1].scene["mpm"], study.variants[0].scene["mpm"]);
}

TEST(AccuracyStudy, RungsOfTwoLaddersThatAreOneSceneAreOneVariant) {
    json accuracy = accuracy_entry();
    accuracy["ladders"][1] = {{"name", "steps"},
                              {"steps", {{"/mpm/cfl=0.2"}, {"/mpm/cell_size=1"}}}};
    const Study study = read_study(study_with(accuracy).dump());
    EXPECT_EQ(study.variants.size(), 4u);
    const auto settings = settings_of(
        [&] {
            std::vector<fault::Fault> none;
            return read_accuracy(study.document["accuracy"], study.scene, none);
        }(),
        study.scene);
    ASSERT_EQ(settings.size(), 5u);
    EXPECT_EQ(settings[4].variants, settings[2].variants);
}

TEST(AccuracyStudy, ReadAgainItIsTheSame) {
    json accuracy = accuracy_entry();
    accuracy["draws"] = 2;
    const Study once = read_study(study_with(accuracy).dump());
    json stored = once.document;
    stored["scene"] = once.scene;
    const Study again = read_study(stored.dump());
    EXPECT_EQ(again.document, once.document);
    ASSERT_EQ(again.variants.size(), once.variants.size());
    EXPECT_EQ(again.variants.back().scene, once.variants.back().scene);
}

TEST(AccuracyStudy, RunsOnlyWhatTheQuantityNeeds) {
    json study = study_with(
        {{"quantity", "crest_displacement@0.5"},
         {"ladders",
          {{{"name", "step"}, {"steps", {{"/fem/stages/1/time_step=0.01"}, {"=0.005"}}}}}}});
    study.erase("transfer_times");
    TaskGraph graph = plan_tasks(read_study(study.dump()), numerics);
    EXPECT_EQ(graph.tasks.size(), 2u);
    EXPECT_EQ(count(graph, "fem_solver"), 2u);
    EXPECT_NE(graph.tasks[0].variant, graph.tasks[1].variant);

    study["scene"].erase("fem");
    study["accuracy"] = {
        {"quantity", "runout"},
        {"draws", 2},
        {"ladders", {{{"name", "cells"}, {"steps", {{"/mpm/cell_size=2"}, {"=1"}}}}}}};
    graph = plan_tasks(read_study(study.dump()), numerics);
    EXPECT_EQ(graph.tasks.size(), 4u);
    EXPECT_EQ(count(graph, "mpm_solver"), 4u) << "a scene without FEM fills its section";
    EXPECT_EQ(graph.tasks[0].release, Release::at_once);
    EXPECT_TRUE(graph.tasks[1].overrides.back().starts_with("/mpm/fill_shift="));
}

TEST(AccuracyStudy, FallingValuesAreSizesAndRisingOnesCounts) {
    json accuracy = accuracy_entry();
    accuracy["ladders"][1].erase("sizes");
    std::vector<fault::Fault> faults;
    json entry = read_study(study_with(accuracy).dump()).document["accuracy"];
    const AccuracyPlan plan = read_accuracy(entry, column_scene(), faults);
    EXPECT_EQ(plan.ladders[0].sizes, (std::vector{4.0, 2.0, 1.0}));
    EXPECT_EQ(plan.ladders[1].sizes, (std::vector{1.0 / 4, 1.0 / 9, 1.0 / 16}));
    EXPECT_TRUE(faults.empty());
}

TEST(AccuracyStudy, RefusesWhatCannotBeJudged) {
    const auto with = [](const std::string& at, const json& value) {
        json study = study_with(accuracy_entry());
        study[json::json_pointer(at)] = value;
        return study;
    };
    const auto unknown = refusal(with("/accuracy/quantity", "runnout"), "/accuracy/quantity");
    EXPECT_NE(unknown.remedy.find("runout_beyond_toe"), std::string::npos);
    refusal(with("/accuracy/quantity", "crest_dispacement@0.5"), "/accuracy/quantity");
    refusal(with("/accuracy/quantity", "crest_displacement@soon"), "/accuracy/quantity");
    refusal(with("/accuracy/quantity", "crest_displacement@9"), "/accuracy/quantity");
    refusal(with("/accuracy/quantity", "crest_displacement@0.5"), "/transfer_times");
    refusal(with("/accuracy/quantity", "factor_of_safety"), "/scene/lem");
    refusal(with("/accuracy/ladders/0/steps", json::array({{"/mpm/cell_size=2"}})),
            "/accuracy/ladders/0/steps");
    refusal(with("/accuracy/ladders/0/steps/1/0", "=1"), "/accuracy/ladders/0/steps/2");
    refusal(with("/accuracy/ladders/0/steps/0/0", "=1"), "/accuracy/ladders/0/steps/0/0");
    refusal(with("/accuracy/ladders/0/steps/0/0", "/mpm/cell_sise=1"),
            "/accuracy/ladders/0/steps/0");
    refusal(with("/accuracy/ladders/1/name", "cells"), "/accuracy/ladders/1/name");
    refusal(with("/accuracy/ladders/1/sizes", {1, 2, 3}), "/accuracy/ladders/1/sizes");
    refusal(with("/accuracy/ladders/1/sizes", {2, 1}), "/accuracy/ladders/1/sizes");
    refusal(with("/accuracy/reference", {{"value", 0}, {"source", "none"}}),
            "/accuracy/reference/value");
    refusal(with("/variants", json::array({{{"name", "soft"}}})), "/variants");
    refusal(with("/triggers", json::array({{{"kind", "manual"}, {"name", "now"}}})), "/triggers");
    refusal(with("/transfer_times", {0.2, 0.4}), "/transfer_times");
    refusal(with("/draws", 3), "/draws");
}

TEST(AccuracyStudy, RefusesARungThatNoPhaseReads) {
    json accuracy = accuracy_entry();
    accuracy["ladders"][0]["steps"] = {{"/mpm/cell_size=2"}, {"/mpm/cell_size=2", "/title=finer"}};
    refusal(study_with(accuracy), "/accuracy/ladders/0/steps/1");
    json of_fem =
        study_with({{"quantity", "crest_displacement@0.5"},
                    {"ladders", {{{"name", "cells"}, {"steps", {{"/mpm/cell_size=2"}, {"=1"}}}}}}});
    of_fem.erase("transfer_times");
    const auto fault = refusal(of_fem, "/accuracy/ladders/0/steps/1");
    EXPECT_NE(fault.cause.find("fem_solver"), std::string::npos);
}

TEST(AccuracyStudy, ALimitNeedsThreeRungsAndTheirSizes) {
    json accuracy = accuracy_entry();
    accuracy["reference"] = "richardson";
    accuracy["ladders"][0]["steps"].erase(2);
    refusal(study_with(accuracy), "/accuracy/ladders/0/steps");
    accuracy = accuracy_entry();
    accuracy["reference"] = "richardson";
    accuracy["ladders"][0]["steps"][1][0] = "/mpm/fill_stress=overburden";
    refusal(study_with(accuracy), "/accuracy/ladders/0/sizes");
}

json study_of_crest() {
    json study = study_with(
        {{"quantity", "crest_displacement@0.5"},
         {"draws", 3},
         {"ladders",
          {{{"name", "step"}, {"steps", {{"/fem/stages/1/time_step=0.01"}, {"=0.005"}}}},
           {{"name", "residual"},
            {"steps", {{"/fem/force_tolerance=1e-4"}, {"/fem/force_tolerance=1e-5"}}}}}}});
    study.erase("transfer_times");
    return study;
}

TEST(AccuracyStudy, RepeatsOfAFemNeedOtherResiduals) {
    json study = study_of_crest();
    EXPECT_NE(refusal(study, "/accuracy/draws").remedy.find("\"draws_of\": \"fem\""),
              std::string::npos);
    study["accuracy"]["draws_of"] = "fem";
    const TaskGraph graph = plan_tasks(read_study(study.dump()), numerics);
    ASSERT_EQ(count(graph, "fem_solver"), 12u) << "each draw has a FEM of its own";
    EXPECT_EQ(graph.tasks[0].overrides.back(), "/fem/stages/1/time_step=0.01");
    const auto last_two = [&](std::size_t task) {
        const std::vector<std::string>& all = graph.tasks[task].overrides;
        return std::vector<std::string>(all.end() - 2, all.end());
    };
    using Two = std::vector<std::string>;
    EXPECT_EQ(last_two(2), (Two{"/fem/force_tolerance=9.025e-07",        // 0.95^2 x 1e-6
                                "/fem/stages/1/time_step=0.00976393"}))  // 1 - 0.1 x 0.236068
        << "of the rung's own step";
    EXPECT_EQ(last_two(8)[0], "/fem/force_tolerance=9.025e-05") << "of what the rung asks for";

    study["accuracy"]["quantity"] = "factor_of_safety";
    study["accuracy"]["ladders"] = {{{"name", "slices"}, {"steps", {{"/lem/slices=10"}, {"=20"}}}}};
    refusal(study, "/accuracy/draws_of");
}

TEST(Draws, OfTheFemHaveOneEachAndOtherLattices) {
    json study = study_with({});
    study.erase("accuracy");
    study["draws"] = 3;
    EXPECT_EQ(count(plan_tasks(read_study(study.dump()), numerics), "fem_solver"), 1u);
    study["draws_of"] = "fem";
    study["variants"] =
        json::array({{{"name", "loose"}, {"overrides", {"/fem/force_tolerance=1e-3"}}}});
    const Study read = read_study(study.dump());
    EXPECT_EQ(count(plan_tasks(read, numerics), "fem_solver"), 3u);
    EXPECT_EQ(read.variants[1].scene["fem"]["force_tolerance"], 9.5e-4);
    const auto step = [&](std::size_t variant) {
        return read.variants[variant].scene["fem"]["stages"][1]["time_step"].get<double>();
    };
    EXPECT_NEAR(step(1), 0.938197 * step(0), 1e-5 * step(0));
    EXPECT_NEAR(step(2), 0.976393 * step(0), 1e-5 * step(0));
    EXPECT_NE(read.variants[1].scene["transfer"]["point_shift"],
              read.variants[0].scene["transfer"]["point_shift"]);
    json waits = study;
    waits["triggers"] = {{{"kind", "criterion"}, {"when", "crest_displacement > 1"}}};
    EXPECT_NE(refusal(waits, "/draws_of").cause.find("a trigger fires at another time"),
              std::string::npos);
    waits["triggers"] = {{{"kind", "at_time"}, {"times", {0.25}}}};
    EXPECT_NO_THROW(read_study(waits.dump()));
    study["scene"].erase("fem");
    study["scene"].erase("transfer");
    study.erase("transfer_times");
    study["variants"] = json::array();
    refusal(study, "/draws_of");
}

TEST(Draws, OfASweepAreVariantsOfTheirOwn) {
    json study = study_with({});
    study.erase("accuracy");
    study["draws"] = 2;
    Study read = read_study(study.dump());
    ASSERT_EQ(read.variants.size(), 2u);
    EXPECT_EQ(read.variants[0].name, "d1");

    study["variants"] =
        json::array({{{"name", "soft_dam"}},
                     {{"name", "stiff"}, {"overrides", {"/materials/sand/law/E_MPa=40"}}}});
    read = read_study(study.dump());
    ASSERT_EQ(read.variants.size(), 4u);
    EXPECT_EQ(read.variants[1].name, "soft_dam_d2");
    json stored = read.document;
    stored["scene"] = read.scene;
    EXPECT_EQ(read_study(stored.dump()).document, read.document);
    study["variants"][0]["name"] = std::string(31, 'a');
    refusal(study, "/variants/0/name");
}

TEST(Draws, OfVariantsAreMadeAgainFromTheStoredStudy) {
    json study = study_with({});
    study.erase("accuracy");
    study["variants"] = {{{"name", "tall"}, {"overrides", {"/mpm/cfl=0.3"}}},
                         {{"name", "slip"}, {"overrides", {"/mpm/cfl=0.2"}}}};
    study["draws"] = 2;
    const Study read = read_study(study.dump());
    json stored = read.document;
    stored["scene"] = read.scene;
    EXPECT_EQ(read_study(stored.dump()).document, read.document);
    EXPECT_EQ(read.variants.at(0).name, "tall");
    stored["variants"] = json::array();
    EXPECT_EQ(read_study(stored.dump()).variants.at(0).name, "d1") << "taken out by hand";
}

TEST(Draws, OfATooLargeNumberOrNoWholeOneAreRefused) {
    json study = study_with({});
    study.erase("accuracy");
    for (const json& wrong : {json(0), json(2.5), json(-1), json(201), json("3")}) {
        study["draws"] = wrong;
        EXPECT_FALSE(refusal(study, "/draws").remedy.empty()) << wrong;
    }
}

TEST(Draws, NeedALatticeThatCanBeMoved) {
    json study = study_with({});
    study.erase("accuracy");
    study["draws"] = 5;
    study["scene"]["transfer"]["points_per_direction"] = 1;
    const fault::Fault told = refusal(study, "/draws");
    EXPECT_NE(told.cause.find("/transfer/point_shift"), std::string::npos) << told.cause;
    EXPECT_NE(told.remedy.find("points_per_direction 2 or more"), std::string::npos) << told.remedy;
    EXPECT_NE(told.remedy.find("leave \"draws\" out"), std::string::npos) << told.remedy;
    try {
        read_study(study.dump());
        FAIL() << "it is accepted";
    } catch (const fault::BadInput& error) {
        EXPECT_EQ(error.faults().size(), 1u) << "not once for each draw";
    }
}

TEST(ValueAt, LiesBetweenTheLinesAndNeverBeyond) {
    const json lines = json::array({{{"time", 0.0}, {"crest", 0.0}},
                                    {{"time", 1.0}, {"crest", 2.0}},
                                    {{"time", 1.5}, {"crest", 3.0}}});
    EXPECT_DOUBLE_EQ(*value_at(lines, "crest", 0.5), 1.0);
    EXPECT_DOUBLE_EQ(*value_at(lines, "crest", 1.0), 2.0);
    EXPECT_DOUBLE_EQ(*value_at(lines, "crest", 1.5), 3.0);
    EXPECT_FALSE(value_at(lines, "crest", 1.6));
    EXPECT_FALSE(value_at(lines, "toe", 1.0));
    EXPECT_FALSE(value_at(json::array(), "crest", 1.0));
}

}  // namespace
}  // namespace breach::orchestrator::accuracy_study_test
