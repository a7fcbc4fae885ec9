// Accuracy studies over the API, with phases of known error: second order in the cells.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <csignal>

#include "tests/faults/service_under_test.hpp"

namespace breach::testing::accuracy_api_test {
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

TEST(Accuracy, ReportsOrderLimitAndCostOfALadder) {
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
    // 0.5 m relative to 0.25 m, which has an error itself
    const double of_cells = 0.1875 / 10.3125 + index;
    EXPECT_NEAR(answer.at("ladders")[0].at("error_of_base").get<double>(), of_cells, 1e-6);
    const json& base = answer.at("rows")[3];
    EXPECT_EQ(base.at("variants"), answer.at("rows")[1].at("variants")) << "one scene, run once";
    EXPECT_NEAR(base.at("error").get<double>(), 0.0, 1e-12) << "cfl changes nothing here";
    EXPECT_EQ(answer.at("ladders")[1].at("course"), "no_effect");
    EXPECT_NE(answer.at("ladders")[1].at("message").get<std::string>().find("does not depend on"),
              std::string::npos);
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

/// Message for an oscillating ladder of meshes: cells of 1, 0.25 and 0.5 m.
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

/// Meshes whose first override has no size, with cells of 1, 0.5 and 0.25 m.
json meshes_without_sizes() {
    return {{"name", "meshes"},
            {"steps",
             {{"/section/regions/0/mesh/divisions=[30,2]",
               "/section/regions/1/mesh/divisions=[15,5]", "/mpm/cell_size=1"},
              {"=[60,4]", "=[30,10]", "=0.5"},
              {"=[90,6]", "=[45,15]", "=0.25"}}}};
}

TEST(Accuracy, RungsOfUnknownSizePromiseNothing) {
    const Sandbox sandbox;
    Service service(sandbox);
    const json meshes = meshes_without_sizes();
    const json cfl = {{"name", "cfl"}, {"steps", {{"/mpm/cfl=0.4"}, {"=0.2"}}}};
    const std::string run = service.submit(
        accuracy_study({{"ladders", json::array({meshes, cfl})}, {"base", meshes.at("steps")[0]}}));
    service.wait_for_end(run);
    const json answer = accuracy_of(service, run);
    const json& ladder = answer.at("ladders")[0];
    EXPECT_EQ(ladder.at("course"), "monotone") << ladder.dump();
    for (const char* untold : {"order", "limit", "gci", "error_of_finest", "error_of_base"})
        EXPECT_TRUE(ladder.at(untold).is_null()) << untold;
    EXPECT_NE(ladder.at("message").get<std::string>().find("\"sizes\""), std::string::npos);
    EXPECT_TRUE(answer.at("rows")[0].at("error").is_number());
    for (const json& row : answer.at("rows")) {
        EXPECT_TRUE(row.at("bias").is_null() && row.at("error_of_a_run").is_null()) << row.dump();
        EXPECT_NE(row.at("reason").get<std::string>().find("\"sizes\""), std::string::npos);
    }
    EXPECT_TRUE(answer.at("recommended").is_null());
    EXPECT_NE(answer.at("recommendation").get<std::string>().find("\"sizes\" give the error"),
              std::string::npos)
        << answer.at("recommendation");
}

TEST(Accuracy, AGivenReferenceNeedsNoSizes) {
    const Sandbox sandbox;
    Service service(sandbox);
    const std::string run = service.submit(
        accuracy_study({{"ladders", json::array({meshes_without_sizes()})},
                        {"reference", {{"value", 10.25}, {"source", "the formula"}}}}));
    service.wait_for_end(run);
    const json answer = accuracy_of(service, run);
    EXPECT_EQ(answer.at("recommended").at("step"), 2) << answer.dump();
}

TEST(Accuracy, ARungThatLostADrawIsNotRecommendedAndSaysSo) {
    const Sandbox sandbox;
    Service service(sandbox);
    json study = accuracy_study({{"draws", 2}});
    study["scene"]["title"] = "by_cell=1 fem_steps=1 mpm_steps=1 fails_above=0.4";
    const std::string run = service.submit(study);
    EXPECT_EQ(service.wait_for_end(run).at("state"), "partial");
    const json answer = accuracy_of(service, run);
    for (const json& row : answer.at("rows")) {
        EXPECT_EQ(row.at("draws"), 1) << "the second lattice failed";
        EXPECT_FALSE(row.at("on_pareto_front"));
        EXPECT_NE(row.at("reason").get<std::string>().find("left the grid"), std::string::npos)
            << row.dump();
    }
    EXPECT_TRUE(
        answer.at("rows")[2].at("reason").get<std::string>().ends_with("; it is the reference"));
    EXPECT_TRUE(answer.at("recommended").is_null());
    EXPECT_TRUE(answer.at("recommendation").get<std::string>().starts_with("No setting can be"))
        << answer.at("recommendation");
}

TEST(Accuracy, CellsThatSoftenWithoutALengthAreReportedAsAnotherSoil) {
    const Sandbox sandbox;
    Service service(sandbox);
    const auto words_of_cells = [&](const json& base) {
        const std::string run = service.submit(accuracy_study({{"base", base}}));
        service.wait_for_end(run);
        return accuracy_of(service, run).at("ladders")[0].at("message").get<std::string>();
    };
    const std::string local = words_of_cells(json::array());
    EXPECT_NE(local.find("without a nonlocal_length"), std::string::npos) << local;
    const std::string nonlocal =
        words_of_cells({"/mpm/softening_length=1", "/materials/slope_soil/nonlocal_length=2"});
    EXPECT_EQ(nonlocal.find("without a nonlocal_length"), std::string::npos) << nonlocal;
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

/// A run of the finest rung scatters by 0.07 %; its bias is 0.003 %.
json noisy_study() {
    return accuracy_study({{"draws", 4},
                           {"asked_error", 0.0015},
                           {"reference", {{"value", 10.3125}, {"source", "the formula"}}}});
}

TEST(Accuracy, WhereOneRunScattersTooMuchItReportsHowManyToAverage) {
    const Sandbox sandbox;
    Service service(sandbox);
    const std::string run = service.submit(noisy_study());
    service.wait_for_end(run);
    const json answer = accuracy_of(service, run);
    const json& best = answer.at("recommended");
    ASSERT_TRUE(best.is_object()) << answer.dump(1);
    EXPECT_EQ(best.at("step"), 3);
    EXPECT_EQ(best.at("draws"), 2);
    EXPECT_DOUBLE_EQ(best.at("cpu_seconds"), 2 * 128.0);
    // Shifts 0, 0.4588, 0.0176, -0.4237 times 2 cm: s = 7.21 mm.
    const double half = 2.3534 * 0.007207 / 10.3125 * std::sqrt(1.0 / 2 + 1.0 / 4);
    EXPECT_NEAR(best.at("error").get<double>(), half + 0.000263 / 10.3125, 2e-6);
    const std::string words = answer.at("recommendation");
    EXPECT_NE(words.find("the mean of 2 repeats of cells: /mpm/cell_size=0.25"), std::string::npos)
        << words;
    EXPECT_NE(words.find("256 CPU s"), std::string::npos) << words;
    EXPECT_TRUE(answer.at("rows")[0].at("mean_within_asked").is_null()) << "its bias is 7 %";
    const json wider =
        service.get("/v1/runs/" + run + "/accuracy?asked_error=0.1").body.at("recommended");
    EXPECT_EQ(wider.at("step"), 1);
    EXPECT_EQ(wider.at("draws"), 1);
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
    for (const json& row : rows(before))
        EXPECT_TRUE(row.at("runout_error_from").get<std::string>().starts_with("usual scatter"));
    const std::string study = service.submit(accuracy_study());
    service.wait_for_end(study);
    const json found = rows(before);
    // Relative to the finest, 10.5 - 10.3125 m, plus the error of that; at the study's own transfer
    // time and at another.
    const double wanted = 0.1875 + 1.25 * 0.0625;
    EXPECT_NEAR(found[0].at("runout_error").get<double>(), wanted, 1e-6);
    EXPECT_NEAR(found[1].at("runout_error").get<double>(), wanted, 1e-6);
    EXPECT_NE(found[0].at("runout_error_from").get<std::string>().find(study), std::string::npos);
    EXPECT_TRUE(found[2].at("runout_error_from").get<std::string>().starts_with("usual scatter"))
        << found[2];
    EXPECT_NE(service.get("/v1/runs/" + before + "/results?format=csv").text.find("runout_error"),
              std::string::npos);

    // The finest has no error relative to itself, but an index: 1.25 x 0.0625 m.
    const json own = rows(study);
    EXPECT_NEAR(own[2].at("runout_error").get<double>(), 1.25 * 0.0625, 1e-6);
    sweep["scene"]["materials"]["slope_soil"]["density"] = 1900;
    const std::string other = service.submit(sweep);
    service.wait_for_end(other);
    EXPECT_TRUE(
        rows(other)[0].at("runout_error_from").get<std::string>().starts_with("usual scatter"))
        << rows(other)[0];
}

/// Results of a sweep with the accuracy study's scene, other entries and no ladders.
json rows_of_sweep(const json& entries) {
    const Sandbox sandbox;
    Service service(sandbox);
    json sweep = accuracy_study();
    sweep.erase("accuracy");
    sweep.update(entries);
    const std::string run = service.submit(sweep);
    service.wait_for_end(run);
    return service.get("/v1/runs/" + run + "/results").body.at("rows");
}

TEST(RunoutError, ComesFromTheSweepsOwnDraws) {
    const json rows = rows_of_sweep({{"draws", 3}});
    ASSERT_EQ(rows.size(), 3u);
    double mean = 0.0;
    for (const json& row : rows) mean += row.at("runout").get<double>() / 3;
    double squares = 0.0;
    for (const json& row : rows) squares += std::pow(row.at("runout").get<double>() - mean, 2);
    for (const json& row : rows)
        EXPECT_NEAR(row.at("runout_error").get<double>(), std::sqrt(squares / 2), 1e-12);
    EXPECT_GT(squares, 0.0);
}

// 0.4 over the cells across the mean depth; independent of the noise.
TEST(RunoutError, WithoutAnAccuracyStudyIncludesTheBiasOfTheCells) {
    json sweep = study("area=3 fem_steps=1 mpm_steps=1", {0.5});
    sweep["scene"]["mpm"]["cell_size"] = 1;
    const json row = rows_of_sweep(sweep).at(0);
    const double beyond = 0.5, noise = 0.5, across = 3 / (beyond * 1.0);
    EXPECT_NEAR(row.at("runout_error").get<double>(), std::hypot(noise, 0.4 / across * beyond),
                1e-9);
    const std::string from = row.at("runout_error_from");
    EXPECT_NE(from.find("6.7 % for cells, 6 across the deposit's mean depth"), std::string::npos)
        << from;

    sweep["draws"] = 2;
    const json repeated = rows_of_sweep(sweep).at(0);
    EXPECT_TRUE(repeated.at("runout_error_from").get<std::string>().starts_with("scatter of 2"));
    EXPECT_NEAR(repeated.at("runout_error").get<double>(), 0.4 / across * beyond, 1e-9)
        << "repeats that do not scatter";
}

TEST(RunoutError, ComesFromNeighboursInTransferTimeWhereNothingWasRepeated) {
    json sweep = accuracy_study();
    sweep["scene"]["fem"]["stages"].back()["duration"] = 5;
    const json rows = rows_of_sweep(
        {{"scene", sweep.at("scene")}, {"transfer_times", {1.0, 2.0, 3.0, 4.0, 5.0}}});
    ASSERT_EQ(rows.size(), 5u);
    const auto runout = [&](std::size_t i) { return rows[i].at("runout").get<double>(); };
    double squares = 0.0;
    for (const std::size_t i : {1, 2, 3})
        squares += std::pow((runout(i - 1) + runout(i + 1)) / 2 - runout(i), 2) / 1.5;
    for (const json& row : rows) {
        EXPECT_NEAR(row.at("runout_error").get<double>(), std::sqrt(squares / 3), 1e-9);
        EXPECT_TRUE(row.at("runout_error_from")
                        .get<std::string>()
                        .starts_with("scatter among neighbouring transfer times"));
    }
}

TEST(RunoutError, OfNeighboursIsAtLeastWhatLatticesScatterBy) {
    // Transfer times so close that the runouts hardly differ.
    const double cell = accuracy_study().at("scene").at("mpm").at("cell_size");
    for (const double step : {1e-3, 1e-5}) {
        json times = json::array();
        for (int i = 0; i < 5; ++i) times.push_back(0.5 + i * step);
        for (const json& row : rows_of_sweep({{"transfer_times", times}})) {
            const double floor = std::max(0.5 * cell, 0.015 * row.at("runout").get<double>());
            EXPECT_NEAR(row.at("runout_error").get<double>(), floor, 1e-12);
            const std::string from = row.at("runout_error_from");
            EXPECT_TRUE(from.starts_with("usual scatter of lattices of points")) << from;
        }
    }
}

TEST(RunoutError, OfAPageOrAFilterIsThatOfTheWholeTable) {
    const Sandbox sandbox;
    Service service(sandbox);
    json sweep =
        study("by_cell=1 fem_steps=1 mpm_steps=1 moving_from=1", {0.25, 0.5, 0.75, 1.0, 1.25});
    sweep["scene"]["mpm"]["cell_size"] = 1;
    const std::string run = service.submit(sweep);
    service.wait_for_end(run);
    const auto rows = [&](const std::string& request) {
        return service.get("/v1/runs/" + run + "/results" + request).body.at("rows");
    };
    const json whole = rows("");
    ASSERT_EQ(whole.size(), 5u);
    for (const json& row : whole) EXPECT_TRUE(row.at("runout_error").is_number());
    EXPECT_EQ(rows("?from=1&limit=2"), json::array({whole[1], whole[2]}));
    EXPECT_EQ(rows("?state=questionable"), json::array({whole[3], whole[4]}));
}

TEST(RunoutError, OfDrawsSaysWhatTransferTimesScatterBy) {
    const json rows =
        rows_of_sweep({{"transfer_times", {0.25, 0.5, 0.75, 1.0, 1.25}}, {"draws", 2}});
    ASSERT_EQ(rows.size(), 10u);
    for (const json& row : rows) {
        const std::string from = row.at("runout_error_from");
        EXPECT_TRUE(from.starts_with("scatter of 2 repeats")) << from;
        EXPECT_NE(from.find("neighbouring transfer times scatter by "), std::string::npos) << from;
    }
}

// Shifts of the first three lattices: 0, 0.4588 and 0.0176, times 2 cm of runout.
json drawn_study(const std::string& title = "") {
    json sweep = study("by_cell=1 fem_steps=1 mpm_steps=1 " + title, {0.5, 0.75});
    sweep["scene"]["mpm"]["cell_size"] = 1;
    sweep["draws"] = 3;
    return sweep;
}

TEST(Means, HaveMeanAndStandardDeviationOfEveryMeasure) {
    const Sandbox sandbox;
    Service service(sandbox);
    json sweep = drawn_study();
    sweep["variants"] = json::array({{{"name", "coarse"}, {"overrides", {"/mpm/cell_size=2"}}},
                                     {{"name", "fine"}, {"overrides", {"/mpm/cell_size=0.5"}}}});
    const std::string run = service.submit(sweep);
    EXPECT_EQ(service.wait_for_end(run).at("tasks").size(), 1u + 1u + 12u + 12u)
        << "one FEM and one stability; the transfer looks at the MPM's cells";
    const json answer = service.get("/v1/runs/" + run + "/results").body;
    EXPECT_EQ(answer.at("rows").size(), 12u) << "single runs stay";
    const json& means = answer.at("means");
    ASSERT_EQ(means.size(), 4u);
    const json& coarse = means[0];
    EXPECT_EQ(coarse.at("variant"), "coarse");
    EXPECT_EQ(coarse.at("draws"), 3);
    EXPECT_EQ(coarse.at("draws_done"), 3);
    EXPECT_EQ(coarse.at("state"), "succeeded");
    const double shifts[]{0.0, 0.458780, 0.017559};
    const double mean = (shifts[0] + shifts[1] + shifts[2]) / 3;
    double squares = 0.0;
    for (const double each : shifts) squares += (each - mean) * (each - mean);
    const double deviation = 0.02 * std::sqrt(squares / 2);
    EXPECT_NEAR(coarse.at("runout").get<double>(), 10.25 + 4.0 + 0.02 * mean, 1e-5);
    EXPECT_NEAR(coarse.at("runout_deviation").get<double>(), deviation, 1e-6);
    EXPECT_NEAR(coarse.at("runout_largest").get<double>(), 12.5, 1e-12);
    EXPECT_NEAR(coarse.at("runout_largest_deviation").get<double>(), 0.0, 1e-12);
    // Two degrees of freedom: t = 2.920.
    EXPECT_NEAR(coarse.at("runout_error").get<double>(), 2.920 * deviation / std::sqrt(3.0), 1e-5);
    EXPECT_NE(coarse.at("runout_error_from").get<std::string>().find("mean of 3 repeats"),
              std::string::npos);
    EXPECT_EQ(means[3].at("variant"), "fine");
    EXPECT_NEAR(means[3].at("transfer_time").get<double>(), 0.75, 1e-12);

    const std::string csv = service.get("/v1/runs/" + run + "/results?format=csv&table=means").text;
    EXPECT_TRUE(csv.starts_with("transfer_time,variant,state,draws,draws_done,runout,runout_dev"))
        << csv;
    EXPECT_EQ(std::ranges::count(csv, '\n'), 5);
    EXPECT_EQ(service.get("/v1/runs/" + run + "/results?table=medians").status, 400);
}

TEST(Means, AFailedRepeatIsReportedAndNotSilentlyLeftOut) {
    const Sandbox sandbox;
    Service service(sandbox);
    const std::string run = service.submit(drawn_study("fails_above=0.4 moving_above=0.01"));
    EXPECT_EQ(service.wait_for_end(run).at("state"), "partial");
    const json means = service.get("/v1/runs/" + run + "/results").body.at("means");
    ASSERT_EQ(means.size(), 2u);
    const json& first = means[0];
    EXPECT_EQ(first.at("state"), "partial");
    EXPECT_EQ(first.at("draws"), 3);
    EXPECT_EQ(first.at("draws_done"), 2);
    EXPECT_EQ(first.at("missing_draws"), "d2: failed");
    EXPECT_EQ(first.at("questionable_draws"), "d3");
    EXPECT_NEAR(first.at("runout").get<double>(), 11.25 + 0.01 * 0.017559, 1e-6);
}

TEST(Means, OfASweepWithoutDrawsThereAreNone) {
    const Sandbox sandbox;
    Service service(sandbox);
    const std::string run = service.submit(study("fem_steps=1 mpm_steps=1", {0.5}));
    service.wait_for_end(run);
    EXPECT_TRUE(service.get("/v1/runs/" + run + "/results").body.at("means").empty());
}

TEST(Means, OfMoreTransferTimesAreOfAllDraws) {
    const Sandbox sandbox;
    Service service(sandbox);
    const std::string run = service.submit(drawn_study());
    service.wait_for_end(run);
    EXPECT_EQ(service.post("/v1/sweeps/" + run + "/extend", R"({"transfer_times": [1.0]})").status,
              202);
    service.wait_for_end(run);
    const json means = service.get("/v1/runs/" + run + "/results").body.at("means");
    ASSERT_EQ(means.size(), 3u);
    EXPECT_EQ(means[2].at("draws_done"), 3);
}

TEST(Means, BiasComesFromTheAccuracyStudyOfAnEqualScene) {
    const Sandbox sandbox;
    Service service(sandbox);
    json sweep = accuracy_study();
    sweep.erase("accuracy");
    sweep["draws"] = 3;
    const std::string run = service.submit(sweep);
    service.wait_for_end(run);
    const std::string study = service.submit(accuracy_study());
    service.wait_for_end(study);
    const json mean = service.get("/v1/runs/" + run + "/results").body.at("means").at(0);
    const double scatter = 2.920 * mean.at("runout_deviation").get<double>() / std::sqrt(3.0);
    // Cells of 1 m relative to 0.25 m, 11.25 - 10.3125 m, plus the error of those: 1.25 x 0.0625 m.
    EXPECT_NEAR(mean.at("runout_error").get<double>(), 0.9375 + 1.25 * 0.0625 + scatter, 1e-4);
    EXPECT_NE(mean.at("runout_error_from").get<std::string>().find(study), std::string::npos);
}

/// As Faults.KillingServiceAndPhasesTogetherLosesNothing, with repeats.
TEST(Means, AreTheSameAfterAKill) {
    const auto means_of = [](Service& service, const std::string& run) {
        return service.get("/v1/runs/" + run + "/results?format=csv&table=means").text;
    };
    std::string undisturbed;
    {
        const Sandbox sandbox;
        Service service(sandbox);
        const std::string run = service.submit(drawn_study("mpm_steps=10"));
        service.wait_for_end(run);
        undisturbed = means_of(service, run);
    }
    const Sandbox sandbox;
    std::string run;
    {
        Service first(sandbox);
        run = first.submit(drawn_study("mpm_steps=10"));
        ASSERT_TRUE(eventually([&] { return !phases_alive(sandbox, "mpm_solver").empty(); }));
        for (const pid_t each : phases_alive(sandbox, "mpm_solver")) kill(each, SIGKILL);
        first.kill_at_once();
    }
    Service again(sandbox);
    EXPECT_EQ(again.wait_for_end(run).at("state"), "succeeded");
    EXPECT_EQ(means_of(again, run), undisturbed);
    for (const auto& [output, count] : sandbox.successes()) EXPECT_EQ(count, 1) << output;
}

}  // namespace
}  // namespace breach::testing::accuracy_api_test
