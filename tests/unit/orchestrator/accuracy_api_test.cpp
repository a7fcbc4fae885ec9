// Accuracy studies over the API, with phases whose error is known: second order in the cells.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/faults/service_under_test.hpp"

namespace breach::testing {
namespace {

using nlohmann::json;

json accuracy_study(const json& more = json::object()) {
    json wanted = study("by_cell=1 fem_steps=1 mpm_steps=1", {0.5});
    wanted["scene"]["mpm"]["cell_size"] = 1;
    wanted["accuracy"] = {
        {"quantity", "runout"},
        {"ladders", {{{"name", "cells"}, {"steps", {{"/mpm/cell_size=1"}, {"=0.5"}, {"=0.25"}}}}}}};
    wanted["accuracy"].update(more);
    return wanted;
}

json accuracy_of(Service& service, const std::string& run) {
    return service.get("/v1/runs/" + run + "/accuracy").body;
}

TEST(Accuracy, TellsOrderLimitAndCostOfALadder) {
    const Sandbox sandbox;
    Service service(sandbox);
    const std::string run = service.submit(accuracy_study({{"reference", "richardson"}}));
    EXPECT_EQ(service.wait_for_end(run).at("state"), "succeeded");
    const json answer = accuracy_of(service, run);
    ASSERT_EQ(answer.at("rows").size(), 3u) << answer.dump();
    const json& ladder = answer.at("ladders")[0];
    EXPECT_EQ(ladder.at("course"), "monotone");
    EXPECT_NEAR(ladder.at("order").get<double>(), 2.0, 1e-6);
    EXPECT_NEAR(ladder.at("limit").get<double>(), 10.25, 1e-6);
    EXPECT_NEAR(ladder.at("gci").get<double>(), 1.25 * 0.0625 / 10.3125, 1e-6);
    const json& coarse = answer.at("rows")[0];
    EXPECT_NEAR(coarse.at("error").get<double>(), 1.0 / 10.25, 1e-6);
    EXPECT_DOUBLE_EQ(coarse.at("cpu_seconds"), 8.0);
    EXPECT_DOUBLE_EQ(coarse.at("peak_memory_MB"), 40.0);
    EXPECT_TRUE(coarse.at("standard_deviation").is_null());
    // Errors are 9.8, 2.4 and 0.6 %.
    EXPECT_EQ(answer.at("recommended").at("step"), 2);
    EXPECT_EQ(answer.at("recommended").at("setting"), json::array({"/mpm/cell_size=0.5"}));
}

TEST(Accuracy, ASettingIsOffByWhatItsBaseIsOffOnTheOtherLadders) {
    const Sandbox sandbox;
    Service service(sandbox);
    json ladders = accuracy_study()["accuracy"]["ladders"];
    ladders.push_back({{"name", "cfl"}, {"steps", {{"/mpm/cfl=0.4"}, {"=0.2"}}}});
    const std::string run =
        service.submit(accuracy_study({{"ladders", ladders}, {"base", {"/mpm/cell_size=0.5"}}}));
    service.wait_for_end(run);
    const json answer = accuracy_of(service, run);
    const double index = 1.25 * 0.0625 / 10.3125;
    const double of_cells = 0.1875 / 10.3125 + index;  // 0.5 m against 0.25 m, which is off itself
    EXPECT_NEAR(answer.at("ladders")[0].at("error_of_base").get<double>(), of_cells, 1e-6);
    const json& base = answer.at("rows")[3];
    EXPECT_EQ(base.at("variants"), answer.at("rows")[1].at("variants")) << "one scene, run once";
    EXPECT_NEAR(base.at("error").get<double>(), 0.0, 1e-12) << "cfl changes nothing here";
    EXPECT_NEAR(base.at("error_of_a_run").get<double>(), of_cells, 1e-6);
    EXPECT_NEAR(answer.at("rows")[2].at("error_of_a_run").get<double>(), index, 1e-6)
        << "the finest is off by its grid convergence index";
}

TEST(Accuracy, NoSettingMeetsWhatIsAskedTooSharply) {
    const Sandbox sandbox;
    Service service(sandbox);
    const std::string run = service.submit(accuracy_study({{"asked_error", 1e-4}}));
    service.wait_for_end(run);
    const json answer = accuracy_of(service, run);
    EXPECT_TRUE(answer.at("recommended").is_null());
    const std::string words = answer.at("recommendation");
    EXPECT_TRUE(words.starts_with("No setting meets"));
    EXPECT_NE(words.find("It is off by 0.76 % by cells"), std::string::npos) << words;
    EXPECT_TRUE(answer.at("rows")[2].at("is_reference"));
    EXPECT_TRUE(answer.at("rows")[2].at("error").is_null());
}

/// What a ladder of meshes says that goes up and down: cells of 1, 0.25 and 0.5 m make it do so.
std::string words_of_meshes(Service& service, const json& base) {
    const json meshes = {{{"name", "meshes"},
                          {"sizes", {2, 1, 0.6667}},
                          {"steps",
                           {{"/section/regions/0/mesh/divisions=[30,2]",
                             "/section/regions/1/mesh/divisions=[15,5]", "/mpm/cell_size=1"},
                            {"=[60,4]", "=[30,10]", "=0.25"},
                            {"=[90,6]", "=[45,15]", "=0.5"}}}}};
    const std::string run = service.submit(accuracy_study({{"ladders", meshes}, {"base", base}}));
    service.wait_for_end(run);
    const json ladder = accuracy_of(service, run).at("ladders")[0];
    EXPECT_EQ(ladder.at("course"), "oscillating");
    return ladder.at("message");
}

TEST(Accuracy, MeshesWithoutALimitAreExplainedWhereTheSoilSoftens) {
    const Sandbox sandbox;
    Service service(sandbox);
    const std::string softening = words_of_meshes(service, json::array());
    EXPECT_NE(softening.find("the soil softens"), std::string::npos) << softening;
    const std::string plain = words_of_meshes(
        service,
        {R"(/materials/slope_soil/law={"type":"mohr_coulomb","E_MPa":20,"nu":0.3,"c_kPa":12,"phi_deg":20})"});
    EXPECT_EQ(plain.find("the soil softens"), std::string::npos) << plain;
}

TEST(Accuracy, DrawsGiveTheNoiseAndRungsOfALaterStudyComeFromTheCache) {
    const Sandbox sandbox;
    Service service(sandbox);
    const std::string run = service.submit(accuracy_study({{"draws", 3}}));
    EXPECT_EQ(service.wait_for_end(run).at("tasks").size(), 1u + 9u + 9u)
        << "one FEM; the transfer looks at the MPM's cells";
    const json answer = accuracy_of(service, run);
    EXPECT_EQ(answer.at("rows")[0].at("draws"), 3);
    EXPECT_GT(answer.at("ladders")[0].at("noise_floor").get<double>(), 0.001);
    const std::string again = service.submit(accuracy_study({{"draws", 2}}));
    const json end = service.wait_for_end(again);
    for (const json& each : end.at("tasks"))
        EXPECT_EQ(each.at("state"), "cached") << each.at("label");
    EXPECT_EQ(accuracy_of(service, again).at("rows")[0].at("draws"), 2);
}

TEST(Accuracy, IsRefusedWithPointerAndRemedy) {
    const Sandbox sandbox;
    Service service(sandbox);
    const auto answer = service.post("/v1/runs", accuracy_study({{"quantity", "runnout"}}).dump());
    EXPECT_EQ(answer.status, 422);
    EXPECT_EQ(answer.body.at("faults")[0].at("pointer"), "/accuracy/quantity");
    EXPECT_FALSE(answer.body.at("faults")[0].at("remedy").get<std::string>().empty());
    const std::string plain = service.submit(study("fem_steps=1 mpm_steps=1", {0.5}));
    EXPECT_EQ(service.get("/v1/runs/" + plain + "/accuracy").status, 404);
    service.wait_for_end(plain);
}

TEST(RunoutError, ComesFromTheAccuracyStudyOfAnEqualScene) {
    const Sandbox sandbox;
    Service service(sandbox);
    json sweep = accuracy_study();
    sweep.erase("accuracy");
    sweep["transfer_times"] = {0.25, 0.5};
    sweep["variants"] = json::array({{{"name", "studied"}, {"overrides", {"/mpm/cell_size=0.5"}}},
                                     {{"name", "not"}, {"overrides", {"/mpm/cell_size=0.2"}}}});
    const std::string before = service.submit(sweep);
    service.wait_for_end(before);
    const auto rows = [&](const std::string& run) {
        return service.get("/v1/runs/" + run + "/results").body.at("rows");
    };
    for (const json& row : rows(before)) {
        EXPECT_TRUE(row.at("runout_error").is_null());
        EXPECT_TRUE(row.at("runout_error_from").get<std::string>().starts_with("no accuracy"));
    }
    const std::string study = service.submit(accuracy_study());
    service.wait_for_end(study);
    const json found = rows(before);
    // Against the finest, 10.5 - 10.3125 m, and what that is off; at the study's own transfer time
    // and at another.
    const double wanted = 0.1875 + 1.25 * 0.0625;
    EXPECT_NEAR(found[0].at("runout_error").get<double>(), wanted, 1e-6);
    EXPECT_NEAR(found[1].at("runout_error").get<double>(), wanted, 1e-6);
    EXPECT_NE(found[0].at("runout_error_from").get<std::string>().find(study), std::string::npos);
    EXPECT_TRUE(found[2].at("runout_error").is_null()) << "its cells are on no ladder";
    EXPECT_NE(service.get("/v1/runs/" + before + "/results?format=csv").text.find("runout_error"),
              std::string::npos);

    // The finest has no error against itself, but an index: 1.25 x 0.0625 m.
    const json own = rows(study);
    EXPECT_NEAR(own[2].at("runout_error").get<double>(), 1.25 * 0.0625, 1e-6);
    sweep["scene"]["materials"]["slope_soil"]["density"] = 1900;
    const std::string other = service.submit(sweep);
    service.wait_for_end(other);
    EXPECT_TRUE(rows(other)[0].at("runout_error").is_null()) << "another soil";
}

TEST(RunoutError, ComesFromTheSweepsOwnDraws) {
    const Sandbox sandbox;
    Service service(sandbox);
    json sweep = accuracy_study();
    sweep.erase("accuracy");
    sweep["draws"] = 3;
    const std::string run = service.submit(sweep);
    service.wait_for_end(run);
    const json rows = service.get("/v1/runs/" + run + "/results").body.at("rows");
    ASSERT_EQ(rows.size(), 3u);
    double mean = 0.0;
    for (const json& row : rows) mean += row.at("runout").get<double>() / 3;
    double squares = 0.0;
    for (const json& row : rows) squares += std::pow(row.at("runout").get<double>() - mean, 2);
    for (const json& row : rows)
        EXPECT_NEAR(row.at("runout_error").get<double>(), std::sqrt(squares / 2), 1e-12);
    EXPECT_GT(squares, 0.0);
}

}  // namespace
}  // namespace breach::testing
