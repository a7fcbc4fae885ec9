// Faults that the service must survive: each test kills or damages something and then checks the
// results table.
#include <gtest/gtest.h>
#include <signal.h>

#include <fstream>
#include <thread>

#include "tests/faults/service_under_test.hpp"

namespace breach::testing {
namespace {

using nlohmann::json;

const std::vector<double> four_times{0.25, 0.5, 1.0, 2.0};

/// Results of an undisturbed service for these times; the fake MPM's runout is 10 + t_T^2.
void expect_whole_table(const json& rows, const std::vector<double>& times) {
    ASSERT_EQ(rows.size(), times.size());
    for (std::size_t i = 0; i < times.size(); ++i) {
        EXPECT_EQ(rows[i].at("state"), "succeeded") << rows[i];
        EXPECT_DOUBLE_EQ(rows[i].at("transfer_time"), times[i]);
        ASSERT_TRUE(rows[i].at("runout").is_number()) << rows[i];
        EXPECT_DOUBLE_EQ(rows[i].at("runout"), 10 + times[i] * times[i]);
    }
}

void expect_no_task_succeeded_twice(const Sandbox& sandbox, const json& run) {
    for (const auto& [output, count] : sandbox.successes()) EXPECT_EQ(count, 1) << output;
    for (const json& task : run.at("tasks")) {
        int well = 0;
        for (const json& attempt : task.at("attempts"))
            well += attempt.at("exit_code") == 0 ? 1 : 0;
        EXPECT_EQ(well, 1) << task.at("label");
    }
}

TEST(Faults, KilledPhaseIsResumedAndTheTableIsTheSame) {
    const Sandbox sandbox;
    Service service(sandbox);
    const std::string run = service.submit(study("fem_steps=20 mpm_steps=20", four_times));
    for (const char* phase : {"fem_solver", "mpm_solver"}) {
        ASSERT_TRUE(eventually([&] { return !phases_alive(sandbox, phase).empty(); }));
        std::this_thread::sleep_for(std::chrono::milliseconds(100));  // during its steps
        for (const pid_t pid : phases_alive(sandbox, phase)) kill(pid, SIGKILL);
    }
    const json end = service.wait_for_end(run);
    EXPECT_EQ(end.at("state"), "succeeded") << end.at("message");
    expect_whole_table(service.table(run), four_times);
    EXPECT_EQ(task_labelled(end, "fem").at("attempts").size(), 2u);
    EXPECT_EQ(task_labelled(end, "fem").at("attempts")[0].at("signal"), SIGKILL);
    expect_no_task_succeeded_twice(sandbox, end);
}

TEST(Faults, KilledSupervisorTakesItsPhaseWithItAndTheAttemptIsRetried) {
    const Sandbox sandbox;
    Service service(sandbox);
    const std::string run = service.submit(study("fem_steps=40", {0.5}));
    ASSERT_TRUE(eventually([&] { return !phases_alive(sandbox, "fem_solver").empty(); }));
    const pid_t phase = phases_alive(sandbox, "fem_solver").front();
    std::ifstream stat("/proc/" + std::to_string(phase) + "/stat");
    std::string word;
    pid_t supervisor = 0;
    stat >> word >> word >> word >> supervisor;
    kill(supervisor, SIGKILL);
    const json end = service.wait_for_end(run);
    EXPECT_EQ(end.at("state"), "succeeded") << end.at("message");
    const json& attempts = task_labelled(end, "fem").at("attempts");
    ASSERT_EQ(attempts.size(), 2u);
    EXPECT_EQ(attempts[0].at("state"), "lost");
    expect_no_task_succeeded_twice(sandbox, end);
}

TEST(Faults, KilledServiceFindsItsPhasesAgainAndTheTableIsTheSame) {
    const Sandbox sandbox;
    std::string run;
    {
        Service first(sandbox);
        run = first.submit(study("fem_steps=30 mpm_steps=30", four_times));
        ASSERT_TRUE(eventually([&] { return !phases_alive(sandbox, "mpm_solver").empty(); }));
        first.kill_at_once();
    }
    {
        Service second(sandbox);  // killed again, in the next part of the sweep
        ASSERT_TRUE(second.valid()) << second.complaint();
        std::this_thread::sleep_for(std::chrono::milliseconds(300));
        second.kill_at_once();
    }
    std::this_thread::sleep_for(
        std::chrono::milliseconds(1200));  // some phases end without a service
    Service third(sandbox);
    ASSERT_TRUE(third.valid()) << third.complaint();
    const json end = third.wait_for_end(run);
    EXPECT_EQ(end.at("state"), "succeeded") << end.at("message");
    expect_whole_table(third.table(run), four_times);
    expect_no_task_succeeded_twice(sandbox, end);
    // No phase was disturbed. Only an attempt that was stored but not started may be repeated.
    for (const json& task : end.at("tasks")) {
        for (const json& attempt : task.at("attempts")) {
            const bool came_through = attempt.at("exit_code") == 0;
            EXPECT_TRUE(came_through || attempt.at("state") == "lost") << task;
            EXPECT_TRUE(came_through || attempt.at("started").is_null()) << task;
        }
    }
}

TEST(Faults, KillingServiceAndPhasesTogetherLosesNothing) {
    const Sandbox sandbox;
    std::string run;
    {
        Service first(sandbox);
        run = first.submit(study("fem_steps=30 mpm_steps=30", four_times));
        ASSERT_TRUE(eventually([&] { return !phases_alive(sandbox, "mpm_solver").empty(); }));
        first.kill_at_once();
        for (const char* phase : {"fem_solver", "mpm_solver"}) {
            for (const pid_t pid : phases_alive(sandbox, phase)) kill(pid, SIGKILL);
        }
    }
    Service second(sandbox);
    const json end = second.wait_for_end(run);
    EXPECT_EQ(end.at("state"), "succeeded") << end.at("message");
    expect_whole_table(second.table(run), four_times);
    expect_no_task_succeeded_twice(sandbox, end);
}

/// Stops a service during the FEM of `run`.
void stop_in_the_middle(const Sandbox& sandbox, std::string& run) {
    Service first(sandbox);
    run = first.submit(study("fem_steps=40", {0.5, 2.5}));
    ASSERT_TRUE(eventually([&] { return !phases_alive(sandbox, "fem_solver").empty(); }));
    first.terminate();
    EXPECT_EQ(first.exit_code(), 0);
    EXPECT_TRUE(phases_alive(sandbox, "fem_solver").empty());
}

TEST(Faults, StoppedServiceGoesOnFromCheckpointsWithoutCountingATry) {
    const Sandbox sandbox;
    std::string run;
    ASSERT_NO_FATAL_FAILURE(stop_in_the_middle(sandbox, run));
    Service second(sandbox, {"--tries", "1"});
    const json end = second.wait_for_end(run);
    EXPECT_EQ(end.at("state"), "succeeded") << end.at("message");
    EXPECT_EQ(task_labelled(end, "fem").at("attempts").size(), 2u);
}

/// As after an upgrade or a disk error.
TEST(Faults, CheckpointThatIsRefusedIsNotTriedTwice) {
    const Sandbox sandbox;
    std::string run;
    ASSERT_NO_FATAL_FAILURE(stop_in_the_middle(sandbox, run));
    std::ofstream(sandbox.data() / "runs" / run / "fem/output/checkpoint.h5") << "of old";
    Service second(sandbox);
    const json end = second.wait_for_end(run);
    EXPECT_EQ(end.at("state"), "succeeded") << end.at("message");
    const json& attempts = task_labelled(end, "fem").at("attempts");
    ASSERT_EQ(attempts.size(), 3u) << attempts;
    EXPECT_EQ(attempts[1].at("exit_code"), 65);
    EXPECT_EQ(attempts[2].at("exit_code"), 0);
}

TEST(Faults, CancelReachesAPhaseThatIgnoresTermAndItsDaemon) {
    const Sandbox sandbox;
    Service service(sandbox);
    const std::string run = service.submit(study("deaf=1 mpm_steps=3000", {0.25}));
    ASSERT_TRUE(eventually([&] { return !phases_alive(sandbox, "mpm_solver").empty(); }));
    const auto daemon_file = sandbox.data() / "runs" / run / "mpm_0.250000/output/daemon.pid";
    ASSERT_TRUE(eventually([&] { return std::filesystem::exists(daemon_file); }));
    pid_t daemon = 0;
    std::ifstream(daemon_file) >> daemon;
    ASSERT_TRUE(is_alive(daemon));
    EXPECT_EQ(service.post("/v1/runs/" + run + "/cancel", "").status, 202);
    EXPECT_EQ(service.post("/v1/runs/" + run + "/cancel", "").status, 202);  // twice is allowed
    const json end = service.wait_for_end(run);
    EXPECT_EQ(end.at("state"), "cancelled");
    EXPECT_FALSE(is_alive(daemon));
    EXPECT_TRUE(phases_alive(sandbox, "mpm_solver").empty());
}

TEST(Faults, CancelSurvivesTheServicesDeath) {
    const Sandbox sandbox;
    std::string run;
    {
        Service first(sandbox, {"--grace", "1"});
        run = first.submit(study("deaf=1 mpm_steps=3000", {0.25}));
        ASSERT_TRUE(eventually([&] { return !phases_alive(sandbox, "mpm_solver").empty(); }));
        first.post("/v1/runs/" + run + "/cancel", "");
        first.kill_at_once();
    }
    Service second(sandbox);
    EXPECT_EQ(second.wait_for_end(run).at("state"), "cancelled");
    EXPECT_TRUE(phases_alive(sandbox, "mpm_solver").empty());
}

TEST(Faults, SecondServiceOnTheSameDataIsRefused) {
    const Sandbox sandbox;
    Service first(sandbox);
    ASSERT_TRUE(first.valid());
    Service second(sandbox);
    EXPECT_FALSE(second.valid());
    EXPECT_EQ(second.exit_code(), 74);
    EXPECT_NE(second.complaint().find("another breachline service"), std::string::npos)
        << second.complaint();
    EXPECT_EQ(first.get("/healthz").status, 200);
}

TEST(Faults, TruncatedSnapshotFailsItsRowAndNoOther) {
    const Sandbox sandbox;
    Service service(sandbox);
    const std::string run = service.submit(study("damage=0.5", four_times));
    EXPECT_EQ(service.wait_for_end(run).at("state"), "partial");
    const json rows = service.table(run);
    ASSERT_EQ(rows.size(), 4u);
    EXPECT_EQ(rows[1].at("state"), "failed");
    EXPECT_NE(rows[1].at("reason").get<std::string>().find("truncated"), std::string::npos)
        << rows[1];
    for (const std::size_t i : {0u, 2u, 3u}) EXPECT_EQ(rows[i].at("state"), "succeeded");
}

TEST(Faults, EntangledMeshIsARegularEndAndWhatLiesBeyondIsNotReached) {
    const Sandbox sandbox;
    Service service(sandbox);
    const std::string run = service.submit(study("entangle_at=1.6 fem_steps=20", four_times));
    const json end = service.wait_for_end(run);
    EXPECT_EQ(end.at("state"), "succeeded");
    EXPECT_EQ(end.at("tasks_failed"), 0);
    const std::string why = "the FEM ended entangled at 1.5 s, before 2 s";
    EXPECT_NE(end.at("message").get<std::string>().find(why), std::string::npos)
        << end.at("message");
    const json rows = service.table(run);
    for (const std::size_t i : {0u, 1u, 2u}) EXPECT_EQ(rows[i].at("state"), "succeeded") << rows[i];
    EXPECT_EQ(rows[3].at("state"), "not_reached");
    EXPECT_EQ(rows[3].at("reason"), why);
    EXPECT_EQ(task_labelled(end, "fem").at("state"), "succeeded");
    EXPECT_EQ(task_labelled(end, "fem").at("result").at("ended"), "entangled");
    EXPECT_EQ(task_labelled(end, "transfer_2.000000").at("state"), "skipped");
    EXPECT_EQ(task_labelled(end, "mpm_2.000000").at("not_reached"), true);
    // Nothing failed, so nothing is retried.
    EXPECT_EQ(service.post("/v1/runs/" + run + "/retry", "").body.value("tasks", 0), 0);
    EXPECT_EQ(service.wait_for_end(run).at("state"), "succeeded");
}

TEST(Faults, ARunWithoutAnyTransferTimeInTheMeshsLifeIsPartial) {
    const Sandbox sandbox;
    Service service(sandbox);
    const std::string run = service.submit(study("entangle_at=1", {2.0, 2.5}));
    const json end = service.wait_for_end(run);
    EXPECT_EQ(end.at("state"), "partial") << "no runout: not what was asked for";
    EXPECT_EQ(end.at("tasks_failed"), 0);
}

TEST(Faults, BreakdownKeepsTheTransfersWhoseSnapshotsExist) {
    const Sandbox sandbox;
    Service service(sandbox);
    const std::string run = service.submit(study("breakdown_at=1.6 fem_steps=20", four_times));
    const json end = service.wait_for_end(run);
    EXPECT_EQ(end.at("state"), "partial");
    EXPECT_NE(end.at("message").get<std::string>().find("no convergence"), std::string::npos)
        << end.at("message");
    const json rows = service.table(run);
    for (const std::size_t i : {0u, 1u, 2u}) EXPECT_EQ(rows[i].at("state"), "succeeded") << rows[i];
    EXPECT_EQ(rows[3].at("state"), "skipped");
    EXPECT_EQ(task_labelled(end, "fem").at("fault").at("exit_code"), 70);
    EXPECT_EQ(task_labelled(end, "fem").at("attempts").size(), 1u);  // 70 is never retried
}

TEST(Faults, TryAgainAndCrashAreRetriedALimitedNumberOfTimes) {
    const Sandbox sandbox;
    Service service(sandbox);
    // The misbehaviour is in the title, which no phase reads: for the cache these are equal.
    const auto submit = [&](const std::string& title) {
        json wanted = study(title, {0.25});
        wanted["reuse"] = false;
        return service.submit(wanted);
    };
    const std::string again = submit("try_again=1");
    const std::string crash = submit("crash=1");
    const std::string never = submit("always_crash=1");
    for (const std::string& run : {again, crash}) {
        const json end = service.wait_for_end(run);
        EXPECT_EQ(end.at("state"), "succeeded");
        EXPECT_EQ(task_labelled(end, "mpm_0.250000").at("attempts").size(), 2u);
    }
    const json end = service.wait_for_end(never);
    EXPECT_EQ(end.at("state"), "failed");
    EXPECT_EQ(task_labelled(end, "mpm_0.250000").at("attempts").size(), 4u);
    EXPECT_NE(end.at("message").get<std::string>().find("killed by signal 9"), std::string::npos);
}

TEST(Faults, MissingProgramFailsTheTaskWithTheReason) {
    const Sandbox sandbox;
    Service service(sandbox);  // asks all four for their version
    std::filesystem::remove(sandbox.bin() / "fem_solver");
    const json end = service.wait_for_end(service.submit(study("", {0.25})));
    EXPECT_EQ(end.at("state"), "failed");
    EXPECT_NE(end.at("message").get<std::string>().find("cannot be started"), std::string::npos)
        << end.at("message");
}

}  // namespace
}  // namespace breach::testing
