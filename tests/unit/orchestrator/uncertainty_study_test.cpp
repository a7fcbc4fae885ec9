// The entry "uncertainty" of a study: its samples, what they share, and refusals.
#include <gtest/gtest.h>

#include <fstream>
#include <set>

#include "services/orchestrator/study/read_study.hpp"
#include "tests/unit/orchestrator/column_study.hpp"

namespace breach::orchestrator::uncertainty_study_test {
namespace {

using nlohmann::json;

const char* const friction = "/mpm/floor/friction/0/coefficient";

json wanted() {
    return json::parse(R"({
      "format": "breachline-study/1", "name": "spread", "transfer_times": [0.4],
      "uncertainty": {"samples": 16, "seed": 7, "parameters": [
        {"name": "floor", "sets": ["/mpm/floor/friction/0/coefficient"],
         "distribution": {"type": "uniform", "from": 0.3, "to": 0.6}},
        {"name": "stiffness", "factor_on": ["/fem/stages/1/duration"],
         "distribution": {"type": "lognormal", "median": 1, "cov": 0.1}, "between": [0.9, 1.5]}]}})");
}

json with_scene(json study) {
    study["scene"] = column_scene();
    study["scene"]["materials"]["sand"]["viscosity"] = 100;
    return study;
}

/// Parameters of the MPM only.
json runout_only() {
    json study = with_scene(wanted());
    study["uncertainty"]["parameters"].erase(1);
    return study;
}

TEST(UncertaintyStudy, SamplesAreVariantsWithTheirDraws) {
    const Study study = read_study(with_scene(wanted()).dump());
    ASSERT_EQ(study.variants.size(), 16u);
    EXPECT_EQ(study.variants[0].name, "s0001");
    EXPECT_EQ(study.variants[15].name, "s0016");
    std::set<std::size_t> slices;
    for (const json& each : study.document.at("variants")) {
        EXPECT_EQ(each.at("made_by"), "uncertainty");
        const double floor = each.at("sample").at("values").at("floor");
        slices.insert(static_cast<std::size_t>((floor - 0.3) / 0.3 * 16));
        const auto overrides = each.at("overrides").get<std::vector<std::string>>();
        EXPECT_EQ(overrides[0], friction + ("=" + json(floor).dump()));
        const double factor = each.at("sample").at("values").at("stiffness");
        EXPECT_NEAR(std::stod(overrides[1].substr(overrides[1].find('=') + 1)), 0.75 * factor,
                    1e-6);
        EXPECT_GE(factor, 0.9);
    }
    EXPECT_EQ(slices.size(), 16u);
    EXPECT_EQ(study.document.at("uncertainty").at("drawn"), 16);
    EXPECT_EQ(study.document.at("uncertainty").at("first_block"), 16);
}

TEST(UncertaintyStudy, WhatTheFemDoesNotReadSharesIt) {
    const TaskGraph graph = plan_tasks(read_study(runout_only().dump()), numerics);
    EXPECT_EQ(count(graph, "fem_solver"), 1u);
    EXPECT_EQ(count(graph, "transfer_tool"), 16u);  // which reads the floor
    EXPECT_EQ(count(graph, "mpm_solver"), 16u);
    json study = runout_only();
    study["uncertainty"]["parameters"][0]["sets"] = {"/mpm/stiffness_scale"};
    const TaskGraph mpm = plan_tasks(read_study(study.dump()), numerics);
    EXPECT_EQ(count(mpm, "fem_solver"), 1u);
    EXPECT_EQ(count(mpm, "transfer_tool"), 1u);
    EXPECT_EQ(count(mpm, "mpm_solver"), 16u);
    const TaskGraph all = plan_tasks(read_study(with_scene(wanted()).dump()), numerics);
    EXPECT_EQ(count(all, "fem_solver"), 16u);
}

TEST(UncertaintyStudy, LatticesShareTheFemAndEachHasItsTransfer) {
    json study = runout_only();
    study["uncertainty"]["parameters"][0]["sets"] = {"/mpm/stiffness_scale"};
    study["uncertainty"]["parameters"].push_back(
        {{"name", "lattice"}, {"numerical", true}, {"draws", 4}});
    const TaskGraph graph = plan_tasks(read_study(study.dump()), numerics);
    EXPECT_EQ(count(graph, "fem_solver"), 1u);
    EXPECT_EQ(count(graph, "transfer_tool"), 4u);
    EXPECT_EQ(count(graph, "mpm_solver"), 16u);
}

TEST(UncertaintyStudy, ReadAgainAndExtendedKeepsTheFirstSamplesAndTheirTasks) {
    json study = with_scene(wanted());
    const Study few = read_study(study.dump());
    json more = few.document;
    more["scene"] = study["scene"];
    EXPECT_EQ(read_study(more.dump()).document, few.document);
    more["uncertainty"]["samples"] = 32;
    more["uncertainty"]["drawn"] = 32;
    const Study many = read_study(more.dump());
    ASSERT_EQ(many.variants.size(), 32u);
    for (std::size_t i = 0; i < 16; ++i)
        EXPECT_EQ(few.document.at("variants")[i], many.document.at("variants")[i]);
    const TaskGraph before = plan_tasks(few, numerics), after = plan_tasks(many, numerics);
    std::set<std::string> labels;
    for (const TaskPlan& each : after.tasks) labels.insert(each.label);
    for (const TaskPlan& each : before.tasks)
        EXPECT_TRUE(labels.contains(each.label)) << each.label;
}

TEST(UncertaintyStudy, UntilDrawsABatchFirst) {
    json study = runout_only();
    study["uncertainty"]["samples"] = 200;
    study["uncertainty"]["until"] = {{"percentile", 90}, {"half_width", 0.1}};
    const Study read = read_study(study.dump());
    EXPECT_EQ(read.variants.size(), 16u);
    EXPECT_EQ(read.document.at("uncertainty").at("drawn"), 16);
    EXPECT_EQ(read.document.at("uncertainty").at("samples"), 200);
}

TEST(UncertaintyStudy, TransfersAtATimeOrWhereATriggerFires) {
    json study = runout_only();
    study.erase("transfer_times");
    study["uncertainty"]["transfer"] = {{"times", {0.3}}};
    EXPECT_EQ(read_study(study.dump()).transfer_times, std::vector<double>{0.3});
    study["uncertainty"]["transfer"] = {{"trigger", "window"}};
    EXPECT_NE(refusal(study, "/uncertainty/transfer/trigger").remedy.find("/triggers"),
              std::string::npos);
    study["triggers"] = {{{"kind", "window"},
                          {"lower", "crest_displacement > 0.1"},
                          {"upper", "crest_displacement > 1"}}};
    const Study read = read_study(study.dump());
    EXPECT_EQ(read.triggers.size(), 1u);
    EXPECT_EQ(count(plan_tasks(read, numerics), "fem_solver"), 1u);
    study["transfer_times"] = {0.4};
    refusal(study, "/transfer_times");
}

TEST(UncertaintyStudy, OneSampleIsOneState) {
    json study = runout_only();
    study["transfer_times"] = {0.3, 0.4};
    refusal(study, "/transfer_times");
    study.erase("transfer_times");
    study["triggers"] = {{{"kind", "bisect"}}};
    refusal(study, "/triggers");
}

/// The study with one more parameter.
json with(const json& parameter) {
    json study = runout_only();
    study["uncertainty"]["parameters"].push_back(parameter);
    return study;
}

json on_viscosity(const json& distribution) {
    return {{"name", "viscosity"},
            {"sets", {"/materials/sand/viscosity"}},
            {"distribution", distribution}};
}

const std::string second = "/uncertainty/parameters/1";

TEST(UncertaintyStudy, RefusesDistributionsThatAreNone) {
    const auto at = [](const json& distribution, const std::string& key) {
        return refusal(with(on_viscosity(distribution)), second + "/distribution" + key);
    };
    EXPECT_NE(at({{"type", "normal"}, {"mean", 100}, {"sd", -10}}, "/sd").cause.find("-10"),
              std::string::npos);
    at({{"type", "lognormal"}, {"median", 100}, {"cov", 0}}, "/cov");
    at({{"type", "lognormal"}, {"median", -1}, {"cov", 0.3}}, "/median");
    at({{"type", "uniform"}, {"from", 2}, {"to", 1}}, "/to");
    at({{"type", "log_uniform"}, {"from", 0}, {"to", 1}}, "/from");
    at({{"type", "triangular"}, {"from", 0}, {"mode", 3}, {"to", 1}}, "/mode");
    at({{"type", "normal"}, {"mean", 1}}, "");
    at({{"type", "normal"}, {"mean", 1}, {"sd", 1}, {"cov", 1}}, "/cov");
    at({{"type", "weibull"}}, "/type");
    json cut = on_viscosity({{"type", "normal"}, {"mean", 100}, {"sd", 10}});
    cut["between"] = {120, 80};
    refusal(with(cut), second + "/between");
    cut["between"] = {300, 400};
    refusal(with(cut), second + "/between");
    json none = on_viscosity({});
    none.erase("distribution");
    refusal(with(none), second);
}

TEST(UncertaintyStudy, RefusesWhatDoesNothing) {
    json study = with(on_viscosity({{"type", "uniform"}, {"from", 1}, {"to", 2}}));
    study["uncertainty"]["parameters"][1]["sets"] = {"/title"};
    refusal(study, "/uncertainty/parameters/1");  // a number instead of words
    study["uncertainty"]["parameters"][1] = {{"name", "words"},
                                             {"one_of", {{"/title=one"}, {"/title=two"}}}};
    const fault::Fault fault = refusal(study, second);
    EXPECT_NE(fault.cause.find("mpm_solver"), std::string::npos) << fault.cause;
    // Only lem_tool reads it, which does not run without "stability".
    json slope = wanted();
    slope.erase("transfer_times");
    slope["scene"] = json::parse(std::ifstream(BREACH_ROOT "/workflows/scenes/flow_slope.json"));
    slope["uncertainty"]["parameters"] = {
        {{"name", "slices"}, {"one_of", {{"/lem/slices=20"}, {"/lem/slices=30"}}}}};
    slope["stability"] = false;
    refusal(slope, "/uncertainty/parameters/0");
    slope["stability"] = true;
    EXPECT_EQ(count(plan_tasks(read_study(slope.dump()), numerics), "lem_tool"), 16u);
}

TEST(UncertaintyStudy, RefusesEntriesThatTheSceneDoesNotHave) {
    json factor{{"name", "nothing"},
                {"factor_on", {"/materials/clay/viscosity"}},
                {"distribution", {{"type", "uniform"}, {"from", 1}, {"to", 2}}}};
    refusal(with(factor), second + "/factor_on/0");
    factor["factor_on"] = {"/materials/sand/law/type"};
    refusal(with(factor), second + "/factor_on/0");
    factor["factor_on"] = {"viscosity"};
    refusal(with(factor), second + "/factor_on/0");
    factor.erase("factor_on");
    factor["sets"] = {"/materials/clay/viscosity"};
    factor["sets"] = {"/materials/sans/viscosity"};
    const fault::Fault misspelt = refusal(with(factor), second + "/sets/0");
    EXPECT_NE(misspelt.cause.find("there is no material \"sans\""), std::string::npos);
    EXPECT_EQ(misspelt.remedy, "did you mean \"sand\"?");
}

TEST(UncertaintyStudy, ReportsAValueThatTheSceneRefusesOnceAtItsParameter) {
    json study = with(on_viscosity({{"type", "normal"}, {"mean", 10}, {"sd", 10}}));
    const fault::Fault fault = refusal(study, second);
    EXPECT_NE(fault.cause.find("/materials/sand/viscosity"), std::string::npos) << fault.cause;
    EXPECT_NE(fault.remedy.find("between"), std::string::npos);
}

TEST(UncertaintyStudy, RefusesASettingThatIsGivenTwice) {
    const json viscosity = on_viscosity({{"type", "uniform"}, {"from", 10}, {"to", 200}});
    json study = with(viscosity);
    study["overrides"] = {"/materials/sand/viscosity=50"};
    refusal(study, "/overrides/0");
    study = with(viscosity);
    study["variants"] = {{{"name", "soft"}, {"overrides", {"/materials/sand/viscosity=50"}}}};
    refusal(study, "/variants");
    study = with(viscosity);
    study["uncertainty"]["parameters"].push_back(viscosity);
    study["uncertainty"]["parameters"][2]["name"] = "again";
    refusal(study, "/uncertainty/parameters/2");
    study["uncertainty"]["parameters"][2] = {
        {"name", "viscosity"}, {"one_of", {{"/mpm/cell_size=1"}, {"/mpm/cell_size=2"}}}};
    refusal(study, "/uncertainty/parameters/2/name");
    study = with(viscosity);
    study["draws"] = 3;
    refusal(study, "/draws");
    // A factor multiplies the value of an override.
    study = with({{"name", "viscosity"},
                  {"factor_on", {"/materials/sand/viscosity"}},
                  {"distribution", {{"type", "uniform"}, {"from", 1}, {"to", 1.0001}}}});
    study["overrides"] = {"/materials/sand/viscosity=50"};
    EXPECT_TRUE(read_study(study.dump())
                    .variants[0]
                    .overrides[1]
                    .starts_with("/materials/sand/viscosity=50"));
}

TEST(UncertaintyStudy, RefusesCorrelationsThatCannotBe) {
    json study = with(on_viscosity({{"type", "uniform"}, {"from", 10}, {"to", 200}}));
    study["uncertainty"]["parameters"].push_back(
        {{"name", "weight"},
         {"factor_on", {"/materials/sand/density"}},
         {"distribution", {{"type", "uniform"}, {"from", 0.9}, {"to", 1.1}}}});
    json& correlation = study["uncertainty"]["correlation"];
    correlation = {
        {"floor", "viscosity", 0.9}, {"floor", "weight", 0.9}, {"viscosity", "weight", -0.9}};
    EXPECT_NE(refusal(study, "/uncertainty/correlation").cause.find("positive definite"),
              std::string::npos);
    correlation = json::array({json::array({"floor", "nobody", 0.3})});
    EXPECT_NE(refusal(study, "/uncertainty/correlation/0/1").remedy.find("viscosity"),
              std::string::npos);
    correlation = json::array({json::array({"floor", "viscosity", 1.0})});
    refusal(study, "/uncertainty/correlation/0/2");
    correlation = json::array({json::array({"floor", "floor", 0.5})});
    refusal(study, "/uncertainty/correlation/0");
    correlation = json::array({json::array({"floor", "viscosity"})});
    refusal(study, "/uncertainty/correlation/0");
    correlation = json::array(
        {json::array({"floor", "viscosity", 0.5}), json::array({"viscosity", "floor", 0.4})});
    refusal(study, "/uncertainty/correlation/1");
    correlation = json::array({json::array({"floor", "viscosity", 0.5})});
    EXPECT_NO_THROW(read_study(study.dump()));
    study["uncertainty"]["samples"] = 4;
    refusal(study, "/uncertainty/samples");
}

TEST(UncertaintyStudy, RefusesChoicesAndNumbersThatAreNone) {
    const json cells{{"name", "cells"}, {"one_of", {{"/mpm/cell_size=1"}, {"/mpm/cell_size=2"}}}};
    json study = with(cells);
    json& parameter = study["uncertainty"]["parameters"][1];
    EXPECT_NO_THROW(read_study(study.dump()));
    parameter["weights"] = {1, 2, 3};
    refusal(study, second + "/weights");
    parameter["weights"] = {1, 0};
    refusal(study, second + "/weights/1");
    parameter["weights"] = {1, 2};
    parameter["names"] = {"fine", "fine"};
    refusal(study, second + "/names/0");
    parameter["names"] = {"fine", "coarse"};
    EXPECT_NO_THROW(read_study(study.dump()));
    parameter["between"] = {1, 2};
    refusal(study, second + "/between");
    parameter = {{"name", "cells"}, {"one_of", {{"/mpm/cell_size=1"}, {"cell_size 2"}}}};
    refusal(study, second + "/one_of/1/0");
    parameter = {{"name", "nothing"}};
    refusal(study, second);
    study = with(cells);
    study["uncertainty"]["correlation"] = json::array({json::array({"floor", "cells", 0.3})});
    EXPECT_NE(refusal(study, "/uncertainty/correlation/0/1").cause.find("order"),
              std::string::npos);
    study = runout_only();
    study["uncertainty"]["samples"] = 0;
    refusal(study, "/uncertainty/samples");
    study = runout_only();
    study["uncertainty"]["quantity"] = "runot";
    EXPECT_NE(refusal(study, "/uncertainty/quantity").remedy.find("runout_beyond_toe"),
              std::string::npos);
}

}  // namespace
}  // namespace breach::orchestrator::uncertainty_study_test
