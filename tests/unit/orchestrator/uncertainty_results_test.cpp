// Uncertainty studies over the API, with phases whose results are known in closed form
// (tests/faults/fake_phase.cpp). Tests of the pure functions cover many seeds.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <string>

#include "core/exchange/archive.hpp"
#include "tests/faults/service_under_test.hpp"

namespace breach::testing::uncertainty_results_test {
namespace {

using nlohmann::json;

json parameter(const char* name, const char* entry, const json& distribution) {
    return {{"name", name}, {"sets", {entry}}, {"distribution", distribution}};
}

json uniform(double from, double to) { return {{"type", "uniform"}, {"from", from}, {"to", to}}; }
json normal(double mean, double sd) { return {{"type", "normal"}, {"mean", mean}, {"sd", sd}}; }

json uncertain_study(const std::string& title, int samples, const json& parameters) {
    json wanted = study(title + " fem_steps=1 mpm_steps=1", {0.5});
    wanted["uncertainty"] = {{"samples", samples}, {"seed", 7}, {"parameters", parameters}};
    return wanted;
}

const json linear_parameters{parameter("a", "/mpm/cfl", normal(0.4, 0.05)),
                             parameter("b", "/mpm/blending_rate", normal(2.0, 0.2)),
                             parameter("c", "/mpm/gimp_half_size", uniform(0.1, 0.4))};

json ended(Service& service, const json& study) {
    const std::string run = service.submit(study);
    service.wait_for_end(run, 120);
    return service.get("/v1/runs/" + run + "/uncertainty").body;
}

bool covers(const json& found, const char* low, const char* high, double value) {
    return found.at(low).get<double>() <= value && value <= found.at(high).get<double>();
}

TEST(UncertaintyResults, OfALinearModelIsItsClosedForm) {
    const Sandbox sandbox;
    Service service(sandbox);
    const json answer = ended(service, uncertain_study("linear=1", 64, linear_parameters));
    ASSERT_EQ(answer.at("samples").at("done"), 64) << answer.dump();
    EXPECT_EQ(answer.at("quantity"), "runout_beyond_toe");
    const json& found = answer.at("quantities").at("runout_beyond_toe");
    EXPECT_EQ(found.at("count"), 64);
    EXPECT_NEAR(found.at("mean").get<double>(), 10.0, 0.1) << "a hypercube knows the mean well";
    EXPECT_NEAR(found.at("sd").get<double>(), std::sqrt(5.0), 0.2);
    // Nine of ten intervals cover: of eight, at least five (three standard deviations of the
    // binomial).
    int covered = 0;
    EXPECT_EQ(found.at("percentiles").size(), 5u);
    for (const json& each : found.at("percentiles")) {
        const double p = each.at("p");
        const double z = p == 5 || p == 95 ? 1.6448536 : p == 50 ? 0.0 : 1.2815516;
        covered += covers(each, "low", "high", 10.0 + (p < 50 ? -z : z) * std::sqrt(5.0)) ? 1 : 0;
    }
    const std::array shares{0.8, 0.2, 0.0};
    for (std::size_t j = 0; j < 3; ++j)
        covered +=
            covers(found.at("importance")[j], "first_order_low", "first_order_high", shares[j]) ? 1
                                                                                                : 0;
    EXPECT_GE(covered, 5) << found.dump();
    EXPECT_GT(found.at("importance")[1].at("partial_rank_correlation"), 0.85)
        << "what a does is taken out";
    EXPECT_GT(found.at("tornado").at("q2"), 0.98);
    EXPECT_EQ(found.at("tornado").at("bars")[0].at("parameter"), "a");
    EXPECT_NEAR(found.at("tornado").at("bars")[0].at("p90").get<double>(), 10.0 + 2.0 * 1.2816,
                0.3);
    EXPECT_FALSE(answer.at("sentences").empty());
}

TEST(UncertaintyResults, OfIshigamisFunctionIsItsClosedFormAndItsTornadoIsRefused) {
    const Sandbox sandbox;
    Service service(sandbox);
    const json parameters{parameter("x1", "/mpm/cfl", uniform(0.2, 0.6)),
                          parameter("x2", "/mpm/blending_rate", uniform(1.0, 3.0)),
                          parameter("x3", "/mpm/gimp_half_size", uniform(0.1, 0.4))};
    const json answer = ended(service, uncertain_study("ishigami=1", 64, parameters));
    const json& found = answer.at("quantities").at("runout_beyond_toe");
    const std::array shares{0.3139, 0.4424, 0.0};  // Saltelli et al. 2008
    for (std::size_t j = 0; j < 3; ++j)
        EXPECT_NEAR(found.at("importance")[j].at("first_order").get<double>(), shares[j], 0.2)
            << "three deviations of such an estimate of 64 samples";
    EXPECT_LT(found.at("tornado").at("q2"), 0.7);
    EXPECT_TRUE(found.at("tornado").contains("refused"));
}

TEST(UncertaintyResults, SamplesThatFailAreCountedAndSaid) {
    const Sandbox sandbox;
    Service service(sandbox);
    // A cfl above 0.4 makes the MPM fail: half of the samples.
    const json answer =
        ended(service, uncertain_study("linear=1 breaks_from=0.4", 8, linear_parameters));
    const json& samples = answer.at("samples");
    EXPECT_EQ(samples.at("planned"), 8);
    EXPECT_EQ(samples.at("done"), 4);
    EXPECT_EQ(samples.at("failed"), 4);
    ASSERT_EQ(samples.at("left_out").size(), 4u);
    EXPECT_EQ(samples.at("left_out")[0].at("state"), "failed");
    EXPECT_NE(samples.at("left_out")[0].at("reason").get<std::string>().find("left the grid"),
              std::string::npos);
    const json& found = answer.at("quantities").at("runout_beyond_toe");
    EXPECT_EQ(found.at("count"), 4);
    EXPECT_EQ(found.at("of"), 8);
    EXPECT_EQ(found.at("percentiles").at("refused"),
              "4 samples are not enough for the 50th percentile: 5 are needed");
    EXPECT_TRUE(
        answer.at("sentences")[0].get<std::string>().starts_with("4 of 8 samples ended with a "
                                                                 "result; 4 without one"))
        << answer.at("sentences").dump();
}

TEST(UncertaintyResults, SamplesComeAsCsvWithDrawsAndResults) {
    const Sandbox sandbox;
    Service service(sandbox);
    const std::string run = service.submit(uncertain_study("linear=1", 3, linear_parameters));
    service.wait_for_end(run);
    const std::string csv = service.get("/v1/runs/" + run + "/uncertainty?format=csv").text;
    EXPECT_TRUE(csv.starts_with("sample,state,a,b,c,runout_beyond_toe,")) << csv;
    EXPECT_EQ(std::ranges::count(csv, '\n'), 4);
    const json rows = service.get("/v1/runs/" + run + "/uncertainty").body.at("rows");
    const double a = rows[0].at("values").at("a");
    const double b = rows[0].at("values").at("b");
    EXPECT_NEAR(rows[0].at("results").at("runout_beyond_toe").get<double>(),
                10.0 + 2.0 * (a - 0.4) / 0.05 + (b - 2.0) / 0.2, 1e-6)
        << "the draws that are told are those that the phase has read";
}

json inverse_study(double target, const json& more = json::object()) {
    json a = parameter("a", "/mpm/cfl", normal(0.4, 0.05));
    a["between"] = {0.3, 0.5};
    json wanted = uncertain_study("linear=1", 60,
                                  {a, parameter("b", "/mpm/blending_rate", normal(2.0, 0.2))});
    wanted["uncertainty"]["target"] = {{"value", target}, {"vary", "a"}};
    wanted["uncertainty"]["target"].update(more);
    return wanted;
}

TEST(InverseStudy, FindsTheValueThatGivesTheTarget) {
    const Sandbox sandbox;
    Service service(sandbox);
    // 10 + 2 (cfl - 0.4) / 0.05, the other at its median: 12 at 0.45. A lattice adds up to 0.1.
    const std::string run = service.submit(inverse_study(12.0));
    EXPECT_EQ(service.wait_for_end(run, 120).at("state"), "succeeded");
    const json answer = service.get("/v1/runs/" + run + "/uncertainty").body;
    const json& inverse = answer.at("inverse");
    ASSERT_EQ(inverse.at("state"), "found") << answer.dump();
    EXPECT_NEAR(inverse.at("value").get<double>(), 0.45, 0.004);
    EXPECT_TRUE(covers(inverse, "low", "high", 0.45)) << inverse.dump();
    EXPECT_LT(inverse.at("high").get<double>() - inverse.at("low").get<double>(), 0.01);
    EXPECT_GT(inverse.at("noise").get<double>(), 0.0);
    const json& steps = inverse.at("steps");
    EXPECT_GT(steps.size(), 3u) << "both ends, and halves between them";
    for (const json& each : steps) EXPECT_EQ(each.at("results").size(), 3u) << each.dump();
    EXPECT_TRUE(answer.at("quantities").empty()) << "values that are searched have no percentiles";
    const json tasks = service.get("/v1/runs/" + run).body.at("tasks");
    EXPECT_EQ(std::ranges::count_if(
                  tasks, [](const json& each) { return each.at("phase") == "fem_solver"; }),
              1)
        << "what only the MPM reads shares the FEM";
}

TEST(InverseStudy, GoesOnAfterAKill) {
    const Sandbox sandbox;
    const std::string run = [&] {
        Service service(sandbox);
        const std::string id = service.submit(inverse_study(12.0));
        const std::string page = "/v1/runs/" + id + "/uncertainty";
        EXPECT_TRUE(eventually(
            [&] { return service.get(page).body.at("inverse").at("steps").size() > 2; }, 60));
        service.kill_at_once();
        return id;
    }();
    Service service(sandbox);
    service.wait_for_end(run, 120);
    const json inverse = service.get("/v1/runs/" + run + "/uncertainty").body.at("inverse");
    EXPECT_EQ(inverse.at("state"), "found");
    EXPECT_NEAR(inverse.at("value").get<double>(), 0.45, 0.004);
}

TEST(InverseStudy, RefusesATargetOutsideOfWhatTheEndsGive) {
    const Sandbox sandbox;
    Service service(sandbox);
    const std::string run = service.submit(inverse_study(215.0, {{"draws", 1}}));
    service.wait_for_end(run, 60);
    const json answer = service.get("/v1/runs/" + run + "/uncertainty").body;
    EXPECT_EQ(answer.at("inverse").at("state"), "refused");
    EXPECT_EQ(answer.at("inverse").at("reason"),
              "runout_beyond_toe is 6 m at 0.3 and 14 m at 0.5: 215 m is not between them");
    EXPECT_EQ(answer.at("inverse").at("steps").size(), 2u);
}

TEST(InverseStudy, FaultsAreReportedWithTheirPlace) {
    const Sandbox sandbox;
    Service service(sandbox);
    const auto refused = [&](const json& study) {
        const Answer answer = service.post("/v1/runs", study.dump());
        EXPECT_EQ(answer.status, 422) << answer.text;
        return answer.text;
    };
    EXPECT_NE(refused(inverse_study(12.0, {{"vary", "c"}})).find("/uncertainty/target/vary"),
              std::string::npos);
    EXPECT_NE(refused(inverse_study(12.0, {{"vary", "b"}})).find("has no ends to search between"),
              std::string::npos);
    EXPECT_NE(
        refused(inverse_study(12.0, {{"quantity", "beauty"}})).find("/uncertainty/target/quantity"),
        std::string::npos);
}

TEST(UncertaintyResults, AreReadBackFromHdf5) {
    const Sandbox sandbox;
    Service service(sandbox);
    const json answer = ended(service, uncertain_study("linear=1", 8, linear_parameters));
    const auto file = sandbox.root() / "samples.h5";
    std::ofstream(file, std::ios::binary)
        << service
               .get("/v1/runs/" + answer.at("run").get<std::string>() + "/uncertainty?format=hdf5")
               .text;
    const auto archive = exchange::read_archive(file, "uncertainty_samples", 1);
    EXPECT_EQ(archive.texts.at("sample"),
              "s0001\ns0002\ns0003\ns0004\ns0005\ns0006\ns0007\ns0008\n");
    EXPECT_EQ(archive.units.at("runout_beyond_toe"), "m");
    const json& rows = answer.at("rows");
    ASSERT_EQ(rows.size(), 8u);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        EXPECT_EQ(archive.reals.at("a")[i], rows[i].at("values").at("a").get<double>());
        EXPECT_EQ(archive.reals.at("runout_beyond_toe")[i],
                  rows[i].at("results").at("runout_beyond_toe").get<double>());
    }
}

TEST(UncertaintyResults, OfAnotherStudyThereIsNone) {
    const Sandbox sandbox;
    Service service(sandbox);
    const std::string run = service.submit(study("fem_steps=1 mpm_steps=1", {0.5}));
    EXPECT_EQ(service.get("/v1/runs/" + run + "/uncertainty").status, 404);
}

}  // namespace
}  // namespace breach::testing::uncertainty_results_test
