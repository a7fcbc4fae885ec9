// A run with a budget stops when it is spent, reports what is missing, and continues with more.
#include <gtest/gtest.h>

#include "tests/faults/service_under_test.hpp"

namespace breach::testing::budget_test {
namespace {

using nlohmann::json;

/// Every fake phase takes some CPU time: the first one exceeds this budget.
json with_budget(double cpu_seconds) {
    json wanted = study("", {0.25, 0.5, 0.75});
    wanted["budget"] = {{"cpu_seconds", cpu_seconds}};
    return wanted;
}

bool is_exhausted(Service& service, const std::string& run) {
    return eventually(
        [&] { return service.get("/v1/runs/" + run).body.at("state") == "budget_exhausted"; });
}

std::size_t attempts_in(const json& run) {
    std::size_t count = 0;
    for (const json& each : run.at("tasks")) count += each.at("attempts").size();
    return count;
}

Answer extended(Service& service, const std::string& run, const std::string& budget) {
    return service.post("/v1/sweeps/" + run + "/extend", "{\"budget\": " + budget + "}");
}

TEST(Budget, StopsNewWorkAndSaysWhatIsMissingAndHowToGoOn) {
    const Sandbox sandbox;
    Service service(sandbox);
    const std::string run = service.submit(with_budget(1e-6));
    ASSERT_TRUE(is_exhausted(service, run));
    const json stopped = service.get("/v1/runs/" + run).body;
    EXPECT_TRUE(stopped.at("finished").is_null());
    EXPECT_GE(stopped.at("spent_cpu_seconds"), 1e-6);
    EXPECT_EQ(stopped.at("budget_cpu_seconds"), 1e-6);
    const std::string message = stopped.at("message");
    EXPECT_NE(message.find("3 mpm_solver"), std::string::npos) << message;
    EXPECT_NE(message.find("breach extend " + run + " --budget "), std::string::npos) << message;
    for (const json& each : stopped.at("tasks")) {
        EXPECT_TRUE(each.at("state") == "ready" || each.at("state") == "blocked" ||
                    each.at("state") == "succeeded")
            << each.at("state");
        if (each.at("phase") == "mpm_solver") {
            EXPECT_TRUE(each.at("attempts").empty());
        }
    }
    const json listed = service.get("/v1/runs?state=budget_exhausted").body.at("runs");
    ASSERT_EQ(listed.size(), 1u);
    EXPECT_EQ(listed[0].at("id"), run);

    ASSERT_EQ(extended(service, run, R"({"cpu_seconds": 1e6})").status, 202);
    const json end = service.wait_for_end(run);
    EXPECT_EQ(end.at("state"), "succeeded") << end.at("message");
    EXPECT_EQ(end.at("study").at("budget").at("cpu_seconds"), 1e6);
    double spent = 0.0;
    for (const json& task : end.at("tasks"))
        for (const json& each : task.at("attempts")) spent += each.at("cpu_seconds").get<double>();
    EXPECT_NEAR(end.at("spent_cpu_seconds"), spent, 1e-9);
}

TEST(Budget, IsWithoutLimitWhenItIsTakenAway) {
    const Sandbox sandbox;
    Service service(sandbox);
    const std::string run = service.submit(with_budget(1e-6));
    ASSERT_TRUE(is_exhausted(service, run));
    ASSERT_EQ(extended(service, run, "null").status, 202);
    const json end = service.wait_for_end(run);
    EXPECT_EQ(end.at("state"), "succeeded") << end.at("message");
    EXPECT_TRUE(end.at("budget_cpu_seconds").is_null());
    EXPECT_FALSE(end.at("study").contains("budget"));
}

TEST(Budget, HoldsOverAKillAndARestart) {
    const Sandbox sandbox;
    std::string run;
    std::size_t attempts = 0;
    json spent;
    {
        Service service(sandbox);
        run = service.submit(with_budget(1e-6));
        ASSERT_TRUE(is_exhausted(service, run));
        const json stopped = service.get("/v1/runs/" + run).body;
        attempts = attempts_in(stopped);
        spent = stopped.at("spent_cpu_seconds");
        service.kill_at_once();
    }
    Service service(sandbox);
    const std::string other = service.submit(study("", {0.5}));  // the dispatcher has had a turn
    EXPECT_EQ(service.wait_for_end(other).at("state"), "succeeded");
    const json after = service.get("/v1/runs/" + run).body;
    EXPECT_EQ(after.at("state"), "budget_exhausted");
    EXPECT_EQ(attempts_in(after), attempts);
    EXPECT_EQ(after.at("spent_cpu_seconds"), spent);
}

TEST(Budget, CountsAttemptsThatFailedAndNothingFromTheCache) {
    const Sandbox sandbox;
    Service service(sandbox);
    json crashing = study("always_crash=1", {0.5});
    crashing["budget"] = {{"cpu_seconds", 1e6}};
    const std::string failed = service.submit(crashing);
    const json end = service.wait_for_end(failed);
    EXPECT_EQ(end.at("state"), "failed");
    const json& mpm = task_labelled(end, "mpm_0.500000");
    EXPECT_GT(mpm.at("attempts").size(), 1u);
    double of_mpm = 0.0;
    double of_others = 0.0;
    for (const json& task : end.at("tasks"))
        for (const json& each : task.at("attempts"))
            (task.at("id") == mpm.at("id") ? of_mpm : of_others) +=
                each.at("cpu_seconds").get<double>();
    EXPECT_GT(of_mpm, 0.0);
    EXPECT_NEAR(end.at("spent_cpu_seconds"), of_mpm + of_others, 1e-9);

    const std::string first = service.submit(study("", {0.5}));
    EXPECT_GT(service.wait_for_end(first).at("spent_cpu_seconds"), 0.0);
    json again = study("", {0.5});
    again["budget"] = {{"cpu_seconds", 1e-6}};
    const json cached = service.wait_for_end(service.submit(again));
    EXPECT_EQ(cached.at("state"), "succeeded") << cached.at("message");
    EXPECT_EQ(cached.at("spent_cpu_seconds"), 0.0);
}

TEST(Budget, IsRefusedWhereItIsInvalidAndReportedBeforehandWhereItIsTooSmall) {
    const Sandbox sandbox;
    Service service(sandbox);
    for (const json& wrong : {json(0), json(-1), json("much"), json(nullptr)}) {
        json wanted = study("", {0.5});
        wanted["budget"] = {{"cpu_seconds", wrong}};
        for (const char* route : {"/v1/runs", "/v1/cost"}) {
            const Answer answer = service.post(route, wanted.dump());
            EXPECT_EQ(answer.status, 422) << wrong << " " << answer.text;
            EXPECT_EQ(answer.body.at("faults")[0].at("pointer"), "/budget/cpu_seconds");
        }
    }
    const std::string run = service.submit(with_budget(1e-6));
    ASSERT_TRUE(is_exhausted(service, run));
    const Answer refused = extended(service, run, R"({"cpu_seconds": 1e-6})");
    EXPECT_EQ(refused.status, 422);
    EXPECT_EQ(refused.body.at("faults")[0].at("pointer"), "/budget/cpu_seconds");
    EXPECT_EQ(extended(service, run, "5").status, 422);

    const json dear = service.post("/v1/cost", with_budget(1e-6).dump()).body;
    EXPECT_EQ(dear.at("budget").at("exceeded"), "yes");
    EXPECT_NE(dear.at("lines").back().get<std::string>().find("will not be enough"),
              std::string::npos);
    EXPECT_EQ(service.post("/v1/cost", with_budget(1e12).dump()).body.at("budget").at("exceeded"),
              "no");
}

TEST(Sweep, IsPlanningUntilATriggerSaysWhenToTransfer) {
    const Sandbox sandbox;
    Service service(sandbox);
    json wanted = study("fem_steps=200", {});
    wanted.erase("transfer_times");
    wanted["triggers"] = {{{"kind", "criterion"}, {"when", "time > 1e6"}}};
    const Answer sent = service.post("/v1/sweeps", wanted.dump());
    ASSERT_EQ(sent.status, 202) << sent.text;
    const std::string run = sent.body.at("id");
    EXPECT_EQ(sent.body.at("state"), "planning");
    EXPECT_EQ(service.get("/v1/sweeps?state=planning").body.at("sweeps")[0].at("id"), run);
    EXPECT_EQ(service.get("/v1/runs?state=planning").status, 400);
    service.post("/v1/sweeps/" + run + "/cancel", "");
    EXPECT_EQ(service.wait_for_end(run).at("state"), "cancelled");
}

}  // namespace
}  // namespace breach::testing::budget_test
