// A service on a failing Slurm: no controller, lost answers, reused job numbers, nodes that accept
// nothing, unlisted jobs. The Slurm is a fake (fake/fake_slurm.py describes its faults).
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <thread>

#include "tests/faults/service_under_test.hpp"

namespace breach::testing {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

const std::vector<double> four_times{0.25, 0.5, 1.0, 2.0};

class SlurmFaults : public ::testing::Test {
  protected:
    fs::path slurm() const { return sandbox_.root() / "slurm"; }
    void begin(const std::string& trouble) {
        fs::create_directories(slurm());
        std::ofstream(slurm() / trouble) << "\n";
    }
    void end(const std::string& trouble) { fs::remove(slurm() / trouble); }
    /// No FEM ends while the gate is closed.
    void close_gate() const { std::ofstream(sandbox_.root() / "gate") << "\n"; }
    void open_gate() const { fs::remove(sandbox_.root() / "gate"); }

    std::unique_ptr<Service> service(std::vector<std::string> more = {}) const {
        std::vector<std::string> arguments{"--executor",    "slurm", "--slurm-poll",          "0.2",
                                           "--slurm-grace", "1",     "--slurm-command-limit", "5"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const std::string path = std::getenv("PATH");
        std::vector<std::string> environment{
            "PATH=" + std::string(BREACH_ROOT) + "/tests/slurm/fake:" + path,
            "FAKE_SLURM=" + slurm().string()};
        environment.insert(environment.end(), environment_.begin(), environment_.end());
        return std::make_unique<Service>(sandbox_, arguments, environment);
    }

    /// Requests to sbatch, in order.
    std::vector<json> asked() const {
        std::vector<json> found;
        std::ifstream stream(slurm() / "asked");
        for (std::string line; std::getline(stream, line);) found.push_back(json::parse(line));
        return found;
    }

    void expect_whole(Service& service, const std::string& run) const {
        const json end = service.wait_for_end(run, 60);
        EXPECT_EQ(end.at("state"), "succeeded") << end.at("message");
        const json rows = service.table(run);
        for (const json& row : rows) {
            const double time = row.at("transfer_time");
            EXPECT_EQ(row.at("runout"), 10 + time * time) << row;
        }
        for (const auto& [output, count] : sandbox_.successes()) EXPECT_EQ(count, 1) << output;
    }

    static std::vector<json> tasks_of(Service& service, const std::string& run) {
        return service.get("/v1/runs/" + run).body.at("tasks");
    }
    static std::size_t attempts_of(Service& service, const std::string& run,
                                   const std::string& label) {
        for (const json& each : tasks_of(service, run))
            if (each.at("label") == label) return each.at("attempts").size();
        throw std::runtime_error("no task " + label);
    }
    bool phase_runs(const std::string& phase) const {
        return eventually([&] { return !phases_alive(sandbox_, phase).empty(); });
    }

    Sandbox sandbox_;
    std::vector<std::string> environment_;  ///< of the services, besides PATH and FAKE_SLURM
};

TEST_F(SlurmFaults, SweepIsWholeAndWhatIsReadyTogetherIsOneArray) {
    const auto service =
        this->service({"--slots", "4", "--slurm-throttle", "2", "--slurm-option=--partition=work"});
    json wanted = study("", four_times);
    wanted["resources"]["mpm_solver"] = {{"cores", 2}, {"memory_MB", 300}};
    wanted["priority"] = 30;
    expect_whole(*service, service->submit(wanted));
    bool array = false, asked_for_resources = false;
    for (const json& each : asked()) {
        EXPECT_TRUE(each.contains("no-requeue") && each.contains("parsable")) << each;
        EXPECT_EQ(each.at("partition"), "work");
        EXPECT_EQ(each.at("nice"), "70");
        array = array || each.value("array", "").ends_with("%2");
        asked_for_resources = asked_for_resources ||
                              (each.at("cpus-per-task") == "2" && each.value("mem", "") == "300M");
    }
    EXPECT_TRUE(array);
    EXPECT_TRUE(asked_for_resources);
}

TEST_F(SlurmFaults, JobThatEndsBeforeItsAnswerDelaysNoOther) {
    // sbatch's answer for the FEM is delayed until the FEM has ended, its exit record was read and
    // the executor has forgotten it. Later tasks with other resources, and so in another call of
    // sbatch, must still be submitted.
    const fs::path hold = sandbox_.root() / "hold";
    std::ofstream(hold) << "\n";
    environment_ = {"BREACHLINE_HOLD=sbatch_after:1:" + hold.string()};
    const auto service = this->service();
    json wanted = study("fem_steps=2", {0.5});
    wanted["resources"]["lem_tool"] = {{"cores", 2}, {"memory_MB", 0}};
    const std::string run = service->submit(wanted);
    const auto state_of = [&](const std::string& label) {
        for (const json& each : tasks_of(*service, run))
            if (each.at("label") == label) return each.at("state").get<std::string>();
        return std::string();
    };
    EXPECT_TRUE(eventually([&] { return state_of("fem") == "succeeded"; }, 30)) << state_of("fem");
    EXPECT_EQ(state_of("lem"), "starting");
    fs::remove(hold);
    expect_whole(*service, run);
    for (const json& each : tasks_of(*service, run))
        EXPECT_EQ(each.at("attempts").size(), 1u) << each.at("label");
}

TEST_F(SlurmFaults, ExceptionBetweenTheAnswerAndItsNotingLosesNoJob) {
    environment_ = {"BREACHLINE_TROUBLE=sbatch_after:1"};
    const auto service = this->service();
    const std::string run = service->submit(study("", four_times));
    expect_whole(*service, run);
    for (const json& each : tasks_of(*service, run))
        EXPECT_EQ(each.at("attempts").size(), 1u) << each.at("label");
}

TEST_F(SlurmFaults, WhatIsWaitedForIsSaid) {
    begin("drained");
    const auto service = this->service();
    const std::string run = service->submit(study("", {0.5}));
    const auto says = [&](const std::string& words) {
        return eventually([&] {
            return std::ranges::any_of(tasks_of(*service, run), [&](const json& each) {
                return each.at("message").get<std::string>().find(words) != std::string::npos;
            });
        });
    };
    EXPECT_TRUE(says("in Slurm's queue: PENDING"));
    const json workers = service->get("/v1/workers").body;
    EXPECT_EQ(workers.at("executor"), "slurm");
    EXPECT_GE(workers.at("slurm").at("states").at("PENDING"), 1);
    EXPECT_GE(workers.at("slurm").at("reasons").at("Resources"), 1);
    EXPECT_TRUE(std::ranges::any_of(workers.at("workers"), [](const json& each) {
        return each.at("job_state") == "PENDING" && each.at("job_reason") == "Resources" &&
               each.at("job").is_string() && each.at("pid").is_null();
    })) << workers;
    begin("down");
    EXPECT_TRUE(says("squeue does not answer"));
    end("down");
    end("drained");
    expect_whole(*service, run);
}

TEST_F(SlurmFaults, ControllerThatIsGoneIsWaitedFor) {
    begin("down");
    const auto service = this->service();
    const std::string run = service->submit(study("fem_steps=20", four_times));
    std::this_thread::sleep_for(std::chrono::milliseconds(1500));
    EXPECT_EQ(service->get("/v1/runs/" + run).body.at("tasks_failed"), 0);
    end("down");
    ASSERT_TRUE(phase_runs("fem_solver"));
    begin("down");  // again with a running job, which ends with a record
    std::this_thread::sleep_for(std::chrono::milliseconds(1500));
    end("down");
    expect_whole(*service, run);
    for (const json& each : tasks_of(*service, run))
        EXPECT_EQ(each.at("attempts").size(), 1u) << each.at("label");
}

TEST_F(SlurmFaults, CommandsThatHangDelayNoRequest) {
    begin("hang");
    const auto service = this->service();
    const std::string run = service->submit(study("", {0.5}));
    for (int i = 0; i < 10; ++i) {
        EXPECT_EQ(service->get("/v1/runs/" + run).status, 200);
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    end("hang");
    expect_whole(*service, run);
}

TEST_F(SlurmFaults, LostAnswerOfSbatchMakesNoSecondJob) {
    begin("lose_answer");
    const auto service = this->service();
    expect_whole(*service, service->submit(study("", {0.5})));
    std::size_t tasks = 0;  // fem, lem, transfer and mpm, some of them in one array
    for (const json& each : asked())
        tasks +=
            each.contains("array") ? 1 + std::stoul(each["array"].get<std::string>().substr(2)) : 1;
    EXPECT_EQ(tasks, 4u);
}

TEST_F(SlurmFaults, SubmissionThatDidNotArriveIsRepeated) {
    begin("drop");
    const auto service = this->service();
    const std::string run = service->submit(study("", {0.5}));
    expect_whole(*service, run);
    for (const json& each : tasks_of(*service, run))
        EXPECT_EQ(each.at("attempts").size(), 1u) << each.at("label");
}

TEST_F(SlurmFaults, RefusalFailsTheTaskWithSlurmsReason) {
    begin("refuse");
    const auto service = this->service({"--tries", "2"});
    const json end = service->wait_for_end(service->submit(study("", {0.5})));
    EXPECT_EQ(end.at("state"), "failed");
    EXPECT_NE(end.at("message").get<std::string>().find("Invalid account"), std::string::npos)
        << end.at("message");
}

TEST_F(SlurmFaults, AFullQuotaOfQueuedJobsIsWaitedForAndTakenPieceByPiece) {
    fs::create_directories(slurm());
    std::ofstream(slurm() / "quota") << "2\n";  // the four transfers would be one array
    const auto service = this->service({"--slots", "8", "--tries", "1"});
    json wanted = study("", four_times);
    wanted["stability"] = false;
    const std::string run = service->submit(wanted);
    expect_whole(*service, run);
    for (const json& each : tasks_of(*service, run))
        EXPECT_EQ(each.at("attempts").size(), 1u) << each.at("label");
}

TEST_F(SlurmFaults, JobThatTheNextServiceSubmitsAsksForWhatItsTaskWants) {
    begin("down");
    json wanted = study("", {0.5});
    wanted["stability"] = false;
    wanted["resources"]["fem_solver"] = {{"cores", 2}, {"memory_MB", 300}};
    wanted["priority"] = 30;
    auto first = service();
    const std::string run = first->submit(wanted);
    const auto fem = [&](Service& of) {
        const json end = of.get("/v1/runs/" + run).body;
        return task_labelled(end, "fem");
    };
    ASSERT_TRUE(eventually([&] {
        return fem(*first).at("message").get<std::string>().starts_with("unknown for ");
    })) << fem(*first);
    first->kill_at_once();
    end("down");
    const auto second = service();
    expect_whole(*second, run);
    ASSERT_FALSE(asked().empty());
    EXPECT_EQ(asked()[0].at("cpus-per-task"), "2");
    EXPECT_EQ(asked()[0].at("mem"), "300M");
    EXPECT_EQ(asked()[0].at("nice"), "70");
    EXPECT_EQ(fem(*second).at("attempts").size(), 1u);
}

TEST_F(SlurmFaults, ForgottenJobsAreRunAgainAndRunningOnesAreNot) {
    // A job forgotten by the controller is lost if queued, but continues if running; its number is
    // reused. Slots for all, so that the first run's transfers cannot block the second run.
    close_gate();
    const auto service = this->service({"--slots", "16"});
    const std::string run = service->submit(study("mpm_steps=5", four_times));
    ASSERT_TRUE(phase_runs("fem_solver"));
    begin("drained");
    const std::string waiting = service->submit(study("", {0.75}));
    ASSERT_TRUE(eventually([&] {
        const json body = service->get("/v1/runs/" + waiting).body;
        return std::ranges::any_of(body.at("tasks"), [](const json& each) {
            return !each.at("attempts").empty() &&
                   each.at("attempts")[0].at("state") == "submitted";
        });
    })) << "a job is in the queue and cannot start";
    begin("forget");
    EXPECT_TRUE(eventually([&] { return !fs::exists(slurm() / "forget"); })) << "it has forgotten";
    EXPECT_FALSE(phases_alive(sandbox_, "fem_solver").empty());
    end("drained");
    open_gate();
    expect_whole(*service, run);
    expect_whole(*service, waiting);
    EXPECT_EQ(attempts_of(*service, run, "fem"), 1u);  // it continued, unlisted
    std::size_t lost = 0;
    for (const json& each : tasks_of(*service, waiting))
        for (const json& attempt : each.at("attempts"))
            lost += attempt.at("state") == "lost" ? 1 : 0;
    EXPECT_GE(lost, 1u);
}

TEST_F(SlurmFaults, DrainedNodeIsWaitedForAndItsJobsCanBeCancelled) {
    begin("drained");
    const auto service = this->service();
    const std::string cancelled = service->submit(study("", {0.5}));
    const auto is_queued = [&](const std::string& run) {
        const json body = service->get("/v1/runs/" + run).body;
        return std::ranges::any_of(body.at("tasks"), [](const json& each) {
            return !each.at("attempts").empty() &&
                   each.at("attempts")[0].at("state") == "submitted";
        });
    };
    ASSERT_TRUE(eventually([&] { return is_queued(cancelled); }));
    service->post("/v1/runs/" + cancelled + "/cancel", "");
    EXPECT_EQ(service->wait_for_end(cancelled).at("state"), "cancelled");
    const std::string run = service->submit(study("", {0.5, 0.75}));
    ASSERT_TRUE(eventually([&] { return is_queued(run); }));
    std::this_thread::sleep_for(std::chrono::milliseconds(1500));  // longer than the grace time
    end("drained");
    expect_whole(*service, run);
    for (const json& each : tasks_of(*service, run))
        EXPECT_EQ(each.at("attempts").size(), 1u) << each.at("label");
}

TEST_F(SlurmFaults, KilledServiceFindsItsJobsAgain) {
    close_gate();
    std::string run;
    {
        const auto first = service();
        run = first->submit(study("", four_times));
        ASSERT_TRUE(phase_runs("fem_solver"));
        first->kill_at_once();
    }
    const auto second = service();
    open_gate();
    expect_whole(*second, run);
    EXPECT_EQ(attempts_of(*second, run, "fem"), 1u);
}

TEST_F(SlurmFaults, StoppedServiceLeavesItsJobsRunning) {
    close_gate();
    std::string run;
    {
        const auto first = service();
        run = first->submit(study("", four_times));
        ASSERT_TRUE(phase_runs("fem_solver"));
        first->terminate();
        EXPECT_EQ(first->exit_code(), 0);
        EXPECT_FALSE(phases_alive(sandbox_, "fem_solver").empty());
    }
    const auto second = service();
    open_gate();
    expect_whole(*second, run);
    EXPECT_EQ(attempts_of(*second, run, "fem"), 1u);
}

TEST_F(SlurmFaults, CancelReachesARunningJob) {
    const auto service = this->service();
    const std::string run = service->submit(study("deaf=1 mpm_steps=3000", {0.25}));
    ASSERT_TRUE(phase_runs("mpm_solver"));
    service->post("/v1/runs/" + run + "/cancel", "");
    EXPECT_EQ(service->wait_for_end(run).at("state"), "cancelled");
    EXPECT_TRUE(phases_alive(sandbox_, "mpm_solver").empty());
}

}  // namespace
}  // namespace breach::testing
