// Order of the queue, limits, and commands for a running run.
#include <gtest/gtest.h>

#include <thread>

#include "tests/faults/service_under_test.hpp"

namespace breach::testing::queue_test {
namespace {

using nlohmann::json;

TEST(Queue, HigherPriorityGoesFirst) {
    const Sandbox sandbox;
    Service service(sandbox, {"--slots", "1"});
    const std::string first = service.submit(study("fem_steps=15", {0.25}));
    json low = study("low", {0.5});
    json high = study("high", {1.0});
    high["priority"] = 5;
    const std::string late = service.submit(low);
    const std::string early = service.submit(high);
    const json late_end = service.wait_for_end(late);
    const json early_end = service.wait_for_end(early);
    EXPECT_LT(task_labelled(early_end, "fem").at("started").get<std::string>(),
              task_labelled(late_end, "fem").at("started").get<std::string>());
    EXPECT_EQ(task_labelled(early_end, "fem").at("priority"), 5);
    EXPECT_EQ(service.post("/v1/runs/" + late + "/priority", "{\"priority\":7}").status, 202);
    EXPECT_EQ(service.post("/v1/runs/" + late + "/priority", "{\"priority\":700}").status, 400);
    EXPECT_EQ(service.post("/v1/runs/nobody/priority", "{\"priority\":7}").status, 404);
}

TEST(Queue, PausedRunStartsNothingUntilItIsResumed) {
    const Sandbox sandbox;
    Service service(sandbox, {"--slots", "1"});
    const std::string busy = service.submit(study("fem_steps=25", {0.25}));
    const std::string run = service.submit(study("waits", {0.25}));
    EXPECT_EQ(service.post("/v1/runs/" + run + "/pause", "").body.at("paused"), true);
    EXPECT_EQ(service.wait_for_end(busy).at("state"), "succeeded");
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    EXPECT_EQ(service.get("/v1/runs/" + run).body.at("state"), "queued");
    EXPECT_EQ(service.post("/v1/runs/" + run + "/resume", "").body.at("paused"), false);
    EXPECT_EQ(service.wait_for_end(run).at("state"), "succeeded");
    EXPECT_EQ(service.post("/v1/runs/nobody/pause", "").status, 404);
}

TEST(Queue, CoresAreCountedAndATaskThatWantsMoreThanThereIsRunsAlone) {
    const Sandbox sandbox;
    Service service(sandbox, {"--slots", "2"});
    json wide = study("mpm_steps=60", {0.25, 0.5, 1.0});
    wide["resources"] = {{"mpm_solver", {{"cores", 2}}}, {"fem_solver", {{"cores", 16}}}};
    const std::string run = service.submit(wide);
    std::size_t most = 0;
    eventually([&] {
        most = std::max(most, phases_alive(sandbox, "mpm_solver").size());
        return !service.get("/v1/runs/" + run).body.at("finished").is_null();
    });
    EXPECT_EQ(service.wait_for_end(run).at("state"), "succeeded");
    EXPECT_EQ(most, 1u);
}

TEST(Queue, LimitOfAPhaseIsKeptAndOthersGoPast) {
    const Sandbox sandbox;
    Service service(sandbox, {"--slots", "4", "--limit", "mpm_solver=1"});
    const std::string run = service.submit(study("mpm_steps=60", {0.25, 0.5, 1.0}));
    std::size_t most = 0;
    eventually([&] {
        most = std::max(most, phases_alive(sandbox, "mpm_solver").size());
        return !service.get("/v1/runs/" + run).body.at("finished").is_null();
    });
    EXPECT_EQ(most, 1u);
    EXPECT_EQ(service.wait_for_end(run).at("state"), "succeeded");
    const Sandbox other;
    Service wrong(other, {"--limit", "tea=1"});
    EXPECT_FALSE(wrong.valid());
    EXPECT_EQ(wrong.exit_code(), 2);
}

TEST(Queue, RetryRunsWhatEndedBadlyAndNothingElse) {
    const Sandbox sandbox;
    Service service(sandbox, {"--tries", "1"});
    std::filesystem::rename(sandbox.bin() / "mpm_solver", sandbox.bin() / "away");
    const std::string run = service.submit(study("", {0.25}));
    EXPECT_EQ(service.wait_for_end(run).at("state"), "failed");
    std::filesystem::rename(sandbox.bin() / "away", sandbox.bin() / "mpm_solver");
    EXPECT_EQ(service.post("/v1/runs/" + run + "/retry", "").status, 202);
    const json end = service.wait_for_end(run);
    EXPECT_EQ(end.at("state"), "succeeded") << end.at("message");
    EXPECT_EQ(end.at("message"), "1 of 1 runouts flagged implausible");
    EXPECT_EQ(task_labelled(end, "fem").at("attempts").size(), 1u);
    EXPECT_EQ(task_labelled(end, "mpm_0.250000").at("attempts").size(), 2u);
}

TEST(Queue, CancelledRunCanBeRetriedWithItsSkippedChildren) {
    const Sandbox sandbox;
    Service service(sandbox);
    const std::string run = service.submit(study("fem_steps=40", {0.25}));
    ASSERT_TRUE(eventually([&] { return !phases_alive(sandbox, "fem_solver").empty(); }));
    service.post("/v1/runs/" + run + "/cancel", "");
    EXPECT_EQ(service.wait_for_end(run).at("state"), "cancelled");
    service.post("/v1/runs/" + run + "/retry", "");
    EXPECT_EQ(service.wait_for_end(run).at("state"), "succeeded");
}

TEST(Queue, OutputsOfAFailedTaskAreHashedToo) {
    const Sandbox sandbox;
    Service service(sandbox);
    const json end = service.wait_for_end(service.submit(study("breakdown_at=1.6", {0.25, 2.0})));
    const std::string fem = task_labelled(end, "fem").at("id");
    EXPECT_TRUE(eventually([&] {
        const json artifacts = service.get("/v1/tasks/" + fem).body.at("artifacts");
        for (const json& each : artifacts)
            if (each.at("name") == "snapshot_0.250000.vtkhdf") return true;
        return false;
    }));
    EXPECT_LT(end.at("tasks_done"), end.at("tasks_total"));  // failed and skipped are not done
}

TEST(Metrics, CountWhatWasDone) {
    const Sandbox sandbox;
    Service service(sandbox);
    service.wait_for_end(service.submit(study("", {0.25})));
    const std::string text = service.get("/metrics").text;
    for (const char* line :
         {"breachline_tasks{state=\"succeeded\"} 4\n", "breachline_attempts{state=\"exited\"} 4\n",
          "breachline_queue_wait_seconds_count 4\n",
          "breachline_dispatch_latency_seconds_count 1\n",
          "breachline_http_requests_total{status=\"2xx\"}", "breachline_store_commit_size_bucket"})
        EXPECT_NE(text.find(line), std::string::npos) << line << "\n" << text;
}

}  // namespace
}  // namespace breach::testing::queue_test
