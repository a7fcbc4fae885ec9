// Uncertainty studies through the whole service with fake phases: planned, extended, stopped when a
// percentile is known well enough, and killed.
#include <gtest/gtest.h>

#include <set>

#include "tests/faults/service_under_test.hpp"

namespace breach::testing::uncertainty_api_test {
namespace {

using nlohmann::json;

/// The fake runout is 10 + t^2 + (stiffness scale)^2.
json spread(std::size_t samples) {
    json wanted = study("by_stiffness=1 mpm_steps=1 fem_steps=3", {0.5});
    wanted["uncertainty"] = {
        {"quantity", "runout"},
        {"samples", samples},
        {"seed", 5},
        {"parameters",
         {{{"name", "stiffness"},
           {"sets", {"/mpm/stiffness_scale"}},
           {"distribution", {{"type", "uniform"}, {"from", 0.5}, {"to", 1.0}}}}}}};
    return wanted;
}

std::size_t count(const json& run, const std::string& phase) {
    std::size_t found = 0;
    for (const json& each : run.at("tasks")) found += each.at("phase") == phase ? 1 : 0;
    return found;
}

std::string extend(Service& service, const std::string& run, const json& body) {
    const Answer answer = service.post("/v1/sweeps/" + run + "/extend", body.dump());
    EXPECT_EQ(answer.status, 202) << answer.text;
    return answer.text;
}

json until_of(Service& service, const std::string& run) {
    return service.get("/v1/runs/" + run + "/uncertainty").body.at("until");
}

TEST(Samples, EachHasItsRowAndSharesTheFem) {
    const Sandbox sandbox;
    Service service(sandbox, {"--slots", "4"});
    const std::string run = service.submit(spread(6));
    const json end = service.wait_for_end(run);
    EXPECT_EQ(end.at("state"), "succeeded") << end.at("message");
    EXPECT_EQ(count(end, "fem_solver"), 1u);
    const json rows = service.table(run);
    ASSERT_EQ(rows.size(), 6u);
    for (std::size_t i = 0; i < 6; ++i) {
        const json& variant = end.at("study").at("variants").at(i);
        EXPECT_EQ(rows[i].at("variant"), variant.at("name"));
        const double h = variant.at("sample").at("values").at("stiffness");
        EXPECT_NEAR(rows[i].at("runout").get<double>(), 10 + 0.25 + h * h, 1e-9);
    }
}

TEST(Samples, ExtendedKeepTheFirstAndRunOnlyTheRest) {
    const Sandbox sandbox;
    Service service(sandbox, {"--slots", "4"});
    const std::string run = service.submit(spread(4));
    service.wait_for_end(run);
    const json before = service.table(run);
    const json answer = json::parse(extend(service, run, {{"samples", 8}}));
    EXPECT_EQ(answer.at("added_samples"), json({"s0005", "s0006", "s0007", "s0008"}));
    const json end = service.wait_for_end(run);
    EXPECT_EQ(end.at("state"), "succeeded") << end.at("message");
    const json rows = service.table(run);
    ASSERT_EQ(rows.size(), 8u);
    std::set<int> slices;
    for (std::size_t i = 0; i < 8; ++i) {
        if (i < 4) {
            EXPECT_EQ(rows[i], before[i]);
        }
        const json& values = end.at("study").at("variants").at(i).at("sample").at("values");
        slices.insert(static_cast<int>((values.at("stiffness").get<double>() - 0.5) / 0.5 * 8));
    }
    EXPECT_EQ(slices.size(), 8u);  // together they are a Latin hypercube again
    EXPECT_EQ(count(end, "fem_solver"), 1u);
    EXPECT_EQ(count(end, "mpm_solver"), 8u);
    for (const json& each : end.at("tasks")) EXPECT_EQ(each.at("attempts").size(), 1u);
    EXPECT_TRUE(json::parse(extend(service, run, {{"samples", 8}})).at("added_samples").empty());
    EXPECT_EQ(service.post("/v1/sweeps/" + run + "/extend", R"({"transfer_times": [0.75]})").status,
              422);
    const std::string plain = service.submit(study("", {0.5}));
    EXPECT_EQ(service.post("/v1/sweeps/" + plain + "/extend", R"({"samples": 8})").status, 422);
    EXPECT_EQ(service.post("/v1/sweeps/" + plain + "/extend", R"({"samples": 0})").status, 400);
}

TEST(Samples, AreTransferredWhereATriggerFiresAlsoThoseThatCameLater) {
    const Sandbox sandbox;
    Service service(sandbox, {"--slots", "4"});
    json wanted = spread(3);
    wanted.erase("transfer_times");
    wanted["triggers"] = {
        {{"kind", "criterion"}, {"when", "time > 0.5"}, {"snapshot_interval_s", 0.5}}};
    wanted["scene"]["fem"]["snapshot_times"] = {1.0};
    wanted["uncertainty"]["transfer"] = {{"trigger", "criterion"}};
    const std::string run = service.submit(wanted);
    EXPECT_EQ(service.wait_for_end(run).at("state"), "succeeded");
    EXPECT_EQ(service.table(run).size(), 3u);
    extend(service, run, {{"samples", 6}});
    const json end = service.wait_for_end(run);
    EXPECT_EQ(end.at("state"), "succeeded") << end.at("message");
    const json rows = service.table(run);
    ASSERT_EQ(rows.size(), 6u);
    for (const json& each : rows) EXPECT_EQ(each.at("transfer_time"), 1.0);
    EXPECT_EQ(count(end, "fem_solver"), 1u);
    EXPECT_EQ(count(end, "mpm_solver"), 6u);
}

TEST(Samples, AreDrawnUntilAPercentileIsKnown) {
    const Sandbox sandbox;
    Service service(sandbox, {"--slots", "8"});
    json wanted = spread(200);
    wanted["uncertainty"]["until"] = {{"percentile", 50}, {"half_width", 0.02}, {"batch", 4}};
    const std::string run = service.submit(wanted);
    const json end = service.wait_for_end(run);
    EXPECT_EQ(end.at("state"), "succeeded") << end.at("message");
    const std::size_t rows = service.table(run).size();
    EXPECT_GE(rows, 8u);  // a median needs at least 5
    EXPECT_LT(rows, 200u);
    EXPECT_EQ(rows % 4, 0u);
    const json until = until_of(service, run);
    EXPECT_EQ(until.at("reached"), true);
    EXPECT_LE(until.at("now").get<double>(), 0.02);
    EXPECT_EQ(until.at("ended"), "");
    EXPECT_EQ(end.at("study").at("uncertainty").at("drawn"), rows);
}

TEST(Samples, EndWhenAllThatWereAskedForAreDrawn) {
    const Sandbox sandbox;
    Service service(sandbox, {"--slots", "8"});
    json wanted = spread(10);
    wanted["uncertainty"]["until"] = {{"percentile", 50}, {"half_width", 1e-6}, {"batch", 4}};
    const std::string run = service.submit(wanted);
    EXPECT_EQ(service.wait_for_end(run).at("state"), "succeeded");
    EXPECT_EQ(service.table(run).size(), 10u);
    const json until = until_of(service, run);
    EXPECT_EQ(until.at("reached"), false);
    EXPECT_NE(until.at("ended").get<std::string>().find("extend"), std::string::npos);
}

TEST(Samples, KilledInTheMiddleGiveTheSameTable) {
    json wanted = spread(12);
    wanted["uncertainty"]["until"] = {{"percentile", 50}, {"half_width", 1e-6}, {"batch", 4}};
    json whole;
    {
        const Sandbox sandbox;
        Service service(sandbox, {"--slots", "4"});
        const std::string run = service.submit(wanted);
        service.wait_for_end(run);
        whole = service.table(run);
        ASSERT_EQ(whole.size(), 12u);
    }
    const Sandbox sandbox;
    std::string run;
    for (const std::size_t done : {2u, 6u, 9u}) {
        Service service(sandbox, {"--slots", "2"});
        ASSERT_TRUE(service.valid()) << service.complaint();
        if (run.empty()) run = service.submit(wanted);
        ASSERT_TRUE(eventually(
            [&] { return service.get("/v1/sweeps/" + run).body.at("points_done") >= done; }));
        service.kill_at_once();
    }
    Service service(sandbox, {"--slots", "4"});
    ASSERT_TRUE(service.valid()) << service.complaint();
    EXPECT_EQ(service.wait_for_end(run).at("state"), "succeeded");
    EXPECT_EQ(service.table(run), whole);
}

TEST(Samples, ArePlannedBeforeTheyAreSubmitted) {
    const Sandbox sandbox;
    Service service(sandbox);
    json wanted = spread(50);
    wanted["uncertainty"]["until"] = {{"percentile", 50}, {"half_width", 0.1}};
    const Answer answer = service.post("/v1/cost", wanted.dump());
    ASSERT_EQ(answer.status, 200) << answer.text;
    EXPECT_EQ(answer.body.at("tasks").at("fem_solver"), 1);
    EXPECT_EQ(answer.body.at("tasks").at("transfer_tool"), 1);
    EXPECT_EQ(answer.body.at("tasks").at("mpm_solver"), 50);  // at most: "until" may stop earlier
    const std::string picture = service.post("/v1/draw", wanted.dump()).text;
    EXPECT_NE(picture.find(answer.body.at("lines").back()), std::string::npos) << picture;
    wanted["uncertainty"]["parameters"][0]["distribution"]["to"] = 0.1;
    const Answer refused = service.post("/v1/cost", wanted.dump());
    EXPECT_EQ(refused.status, 422);
    EXPECT_NE(refused.text.find("/uncertainty/parameters/0/distribution/to"), std::string::npos);
    EXPECT_TRUE(service.get("/v1/runs").body.at("runs").empty());
}

}  // namespace
}  // namespace breach::testing::uncertainty_api_test
