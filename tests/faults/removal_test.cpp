// Runs are removed while others share their files or reuse their results, and while the service is
// killed at each step.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <fstream>
#include <iostream>
#include <random>
#include <sstream>
#include <thread>

#include "services/orchestrator/files/failpoint.hpp"
#include "tests/faults/invariants.hpp"

namespace breach::testing {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

fs::path folder_of(const Sandbox& sandbox, const std::string& run) {
    return sandbox.data() / "runs" / run;
}

Answer remove(Service& service, const std::string& run) {
    return service.ask("DELETE", "/v1/runs/" + run);
}

bool nothing_is_being_removed(Service& service) {
    return eventually([&] {
        const Answer answer = service.get("/v1/storage");
        return answer.status == 200 && answer.body.at("removing") == 0;
    });
}

int count_in_state(const json& run, const std::string& state) {
    int count = 0;
    for (const json& task : run.at("tasks")) count += task.at("state") == state ? 1 : 0;
    return count;
}

const json& use_of(const json& storage, const std::string& run) {
    for (const json& each : storage.at("runs"))
        if (each.at("id") == run) return each;
    throw std::runtime_error("no run " + run + " in " + storage.dump());
}

TEST(Removal, FreesWhatNoOtherRunHoldsAndNoMore) {
    const Sandbox sandbox;
    Service service(sandbox);
    const std::string first = service.submit(study("", {0.25, 0.5}));
    service.wait_for_end(first);
    const std::string second = service.submit(study("", {0.25, 0.5}));
    ASSERT_EQ(count_in_state(service.wait_for_end(second), "cached"), 6);
    const json before = service.get("/v1/storage").body;
    EXPECT_GT(use_of(before, first).at("shared_bytes"), 0);
    EXPECT_EQ(use_of(before, first).at("shared_bytes"), use_of(before, second).at("shared_bytes"));
    EXPECT_EQ(use_of(before, first).at("shared_with"), json::array({second}));
    EXPECT_EQ(use_of(before, first).at("bytes").get<long>(),
              use_of(before, first).at("shared_bytes").get<long>() +
                  use_of(before, first).at("freed_bytes").get<long>());

    const Answer answer = remove(service, first);
    ASSERT_EQ(answer.status, 202) << answer.text;
    EXPECT_EQ(answer.body.at("freed_bytes"), use_of(before, first).at("freed_bytes"));
    EXPECT_EQ(service.get("/v1/runs/" + first).status, 404);
    EXPECT_EQ(remove(service, first).status, 404);
    ASSERT_TRUE(nothing_is_being_removed(service));
    EXPECT_FALSE(fs::exists(folder_of(sandbox, first)));
    const json after = service.get("/v1/storage").body;
    EXPECT_EQ(after.at("runs_bytes").get<long>(),
              before.at("runs_bytes").get<long>() - answer.body.at("freed_bytes").get<long>());
    EXPECT_EQ(use_of(after, second).at("shared_bytes"), 0);
    EXPECT_EQ(use_of(after, second).at("freed_bytes"), use_of(before, second).at("bytes"));

    // The remaining run gives the same answers.
    const json kept = service.get("/v1/runs/" + second).body;
    EXPECT_TRUE(task_labelled(kept, "fem").at("same_as").is_null());
    const std::string fem = task_labelled(kept, "fem").at("id");
    EXPECT_EQ(service.get("/v1/tasks/" + fem).body.at("why").at("reason"),
              "taken from an earlier task, which was removed");
    for (const json& file : task_labelled(kept, "fem").at("artifacts"))
        EXPECT_EQ(service.get("/v1/artifacts/" + file.at("sha256").get<std::string>()).status, 200);
    const json third = service.wait_for_end(service.submit(study("", {0.25, 0.5})));
    EXPECT_EQ(count_in_state(third, "cached"), 6);
    EXPECT_EQ(task_labelled(third, "fem").at("same_as"), fem);
    EXPECT_EQ(sandbox.successes().size(), 6u) << "nothing was computed twice";
}

TEST(Removal, IsRefusedWhileTheRunGoesOnOrIsPinned) {
    const Sandbox sandbox;
    Service service(sandbox);
    const std::string run = service.submit(study("fem_steps=2000", {0.25}));
    const Answer early = remove(service, run);
    EXPECT_EQ(early.status, 409);
    EXPECT_EQ(early.body.at("type"), "/problems/going-on");
    EXPECT_NE(early.body.at("detail").get<std::string>().find("breach cancel " + run),
              std::string::npos);
    service.post("/v1/runs/" + run + "/cancel", "");
    EXPECT_EQ(service.wait_for_end(run).at("state"), "cancelled");
    EXPECT_EQ(remove(service, run).status, 202);
    EXPECT_EQ(remove(service, "nobody").status, 404);
    EXPECT_EQ(service.get("/v1/runs").body.at("runs").size(), 0u);
    EXPECT_TRUE(nothing_is_being_removed(service));
    EXPECT_TRUE(fs::is_empty(sandbox.data() / "runs"));
}

TEST(Removal, AListenerGetsTheEventAndTheKeyIsFreeAgain) {
    const Sandbox sandbox;
    Service service(sandbox);
    const std::string wanted = study("", {0.25}).dump();
    const std::multimap<std::string, std::string> key{{"Idempotency-Key", "k"}};
    const std::string run = service.post("/v1/runs", wanted, "application/json", key).body.at("id");
    service.wait_for_end(run);
    const json seen = service.get("/v1/events?after=0&wait=0").body;
    ASSERT_EQ(remove(service, run).status, 202);
    const json news =
        service.get("/v1/events?wait=0&after=" + seen.at("next").dump()).body.at("events");
    ASSERT_EQ(news.size(), 1u);
    EXPECT_EQ(news[0].at("run"), run);
    EXPECT_EQ(news[0].at("detail").at("event"), "remove");
    const Answer again = service.post("/v1/runs", wanted, "application/json", key);
    EXPECT_EQ(again.status, 202);
    EXPECT_NE(again.body.at("id"), run);
    EXPECT_EQ(service.wait_for_end(again.body.at("id")).at("state"), "succeeded");
}

TEST(Removal, TakesTheOldestBeyondWhatTheServiceMayKeep) {
    const Sandbox sandbox;
    std::vector<std::string> runs;
    {
        Service service(sandbox);
        for (int i = 0; i < 3; ++i) {
            json wanted = study("", {0.25});
            wanted["reuse"] = false;
            runs.push_back(service.submit(wanted));
            service.wait_for_end(runs.back());
        }
    }
    {
        Service service(sandbox, {"--keep-days", "1", "--keep-gb", "100"});
        ASSERT_TRUE(nothing_is_being_removed(service));
        EXPECT_EQ(service.get("/v1/runs").body.at("runs").size(), 3u);
        const json held = service.get("/v1/storage").body;
        EXPECT_EQ(held.at("keep_days"), 1);
    }
    Service service(sandbox, {"--keep-gb", "0.0000001"});  // less than the database alone
    EXPECT_TRUE(eventually([&] { return service.get("/v1/runs").body.at("runs").empty(); }));
    std::vector<std::string> removed;
    const json events = service.get("/v1/events?after=0&wait=0").body.at("events");
    for (const json& each : events)
        if (each.at("detail").value("event", "") == "remove") removed.push_back(each.at("run"));
    EXPECT_EQ(removed, runs) << "the one that ended first goes first";
    ASSERT_TRUE(nothing_is_being_removed(service));
    EXPECT_FALSE(fs::exists(folder_of(sandbox, runs[0])));
}

/// A service that waits at `place` until the file is removed.
std::vector<std::string> holding_at(const std::string& place, const fs::path& file) {
    std::ofstream(file) << "\n";
    return {"BREACHLINE_HOLD=" + place + ":1:" + file.string()};
}

TEST(Removal, OfWhatIsBeingAnsweredFromMakesTheTaskRunItself) {
    const Sandbox sandbox;
    const auto hold = sandbox.root() / "hold";
    Service service(sandbox, {"--slots", "1"}, holding_at("reuse_placed", hold));
    const std::string first = service.submit(study("", {0.25}));
    service.wait_for_end(first);
    const std::string second = service.submit(study("", {0.25}));
    const auto placed = folder_of(sandbox, second) / "fem/output/result.json";
    ASSERT_TRUE(eventually([&] { return fs::exists(placed); }));
    ASSERT_EQ(remove(service, first).status, 202);
    ASSERT_TRUE(nothing_is_being_removed(service));
    fs::remove(hold);
    const json end = service.wait_for_end(second);
    EXPECT_EQ(end.at("state"), "succeeded") << end.dump();
    EXPECT_EQ(count_in_state(end, "cached"), 0);
    EXPECT_EQ(task_labelled(end, "fem").at("attempts").size(), 1u);
    EXPECT_FALSE(fs::exists(folder_of(sandbox, second) / "fem/reused"));
    EXPECT_EQ(service.table(second)[0].at("runout"), 10.0625);
}

TEST(Removal, WhatWasPlacedAndNotTakenIsNotWrittenInto) {
    const Sandbox sandbox;
    std::string first;
    std::string second;
    const auto token = sandbox.root() / "token";
    {
        std::ofstream(token) << "\n";
        Service service(sandbox, {}, {"BREACHLINE_FAILPOINT=reuse_placed:1:" + token.string()});
        first = service.submit(study("", {0.25}));
        service.wait_for_end(first);
        second = service.post("/v1/runs", study("", {0.25}).dump()).body.value("id", "");
        ASSERT_TRUE(eventually([&] { return !fs::exists(token); }));
        service.kill_at_once();
    }
    {
        // Damages the result that would be reused, so that the task must run.
        const auto file = folder_of(sandbox, first) / "fem/output/result.json";
        struct stat info {};
        ASSERT_EQ(stat(file.c_str(), &info), 0);
        EXPECT_EQ(info.st_nlink, 2u) << "it was placed";
        const std::string kept = (std::ostringstream() << std::ifstream(file).rdbuf()).str();
        fs::remove(folder_of(sandbox, first) / "fem/output/telemetry.jsonl");
        Service service(sandbox);
        ASSERT_TRUE(service.valid()) << service.complaint();
        const std::string run = service.get("/v1/runs?limit=1").body.at("runs")[0].at("id");
        const json end = service.wait_for_end(run);
        EXPECT_EQ(end.at("state"), "succeeded") << end.value("message", "");
        EXPECT_EQ(task_labelled(end, "fem").at("state"), "succeeded");
        EXPECT_EQ((std::ostringstream() << std::ifstream(file).rdbuf()).str(), kept);
        ASSERT_EQ(stat(file.c_str(), &info), 0);
        EXPECT_EQ(info.st_nlink, 1u) << "the new run has its own";
    }
}

/// Submits equal studies, which reuse each other's results, and removes them all at once.
TEST(Removal, NeverTakesAFileFromARunThatIsAnsweredWithIt) {
    const char* wanted = std::getenv("BREACH_RACES");
    const int rounds = wanted == nullptr ? 6 : std::atoi(wanted);
    const Sandbox sandbox;
    int cached = 0, ran = 0;
    std::vector<std::string> left;
    {
        Service service(sandbox);
        std::mt19937 random(5);
        for (int round = 0; round < rounds; ++round) {
            std::vector<std::string> fresh;
            for (int i = 0; i < 2; ++i) fresh.push_back(service.submit(study("", {0.25, 0.5})));
            std::this_thread::sleep_for(std::chrono::milliseconds(random() % 120));
            for (const std::string& each : left)
                EXPECT_EQ(service.ask("DELETE", "/v1/runs/" + each).status, 202);
            left.clear();
            for (const std::string& run : fresh) {
                const json end = service.wait_for_end(run, 60);
                ASSERT_EQ(end.at("state"), "succeeded") << end.dump();
                for (const json& row : service.table(run)) {
                    const double time = row.at("transfer_time");
                    EXPECT_EQ(row.at("runout"), 10 + time * time);
                }
                cached += count_in_state(end, "cached");
                ran += count_in_state(end, "succeeded");
                left.push_back(run);
            }
        }
        ASSERT_TRUE(nothing_is_being_removed(service));
    }
    std::cout << rounds << " rounds: " << cached << " tasks were answered, " << ran << " ran\n";
    EXPECT_GE(ran, 6);
    expect_sound_history(sandbox);
    for (const auto& entry : fs::recursive_directory_iterator(sandbox.data() / "runs"))
        EXPECT_NE(entry.path().filename(), "reused") << entry.path();
}

class KilledWhileRemoving : public ::testing::TestWithParam<std::string> {};

TEST_P(KilledWhileRemoving, TheRunIsWholeOrGone) {
    const Sandbox sandbox;
    std::string first;
    std::string second;
    {
        Service service(sandbox);
        first = service.submit(study("", {0.25, 0.5}));
        service.wait_for_end(first);
        second = service.submit(study("", {0.25, 0.5}));
        service.wait_for_end(second);
    }
    const auto token = sandbox.root() / "token";
    std::ofstream(token) << "\n";
    int status = 0;
    {
        Service service(sandbox, {},
                        {"BREACHLINE_FAILPOINT=" + GetParam() + ":1:" + token.string()});
        status = remove(service, first).status;
        ASSERT_TRUE(eventually([&] { return !fs::exists(token); })) << "not reached";
        service.kill_at_once();
    }
    {
        Service service(sandbox);
        ASSERT_TRUE(service.valid()) << service.complaint();
        ASSERT_TRUE(nothing_is_being_removed(service));
        const bool gone = service.get("/v1/runs/" + first).status == 404;
        if (status == 202) {
            EXPECT_TRUE(gone) << "acknowledged";
        }
        EXPECT_EQ(gone, GetParam() != "store_before_commit");
        EXPECT_EQ(fs::exists(folder_of(sandbox, first)), !gone);
        const json third = service.wait_for_end(service.submit(study("", {0.25, 0.5})));
        EXPECT_EQ(count_in_state(third, "cached"), 6);
    }
    expect_sound_history(sandbox);  // checks the hash of every file of the others
}

INSTANTIATE_TEST_SUITE_P(Place, KilledWhileRemoving,
                         ::testing::Values("store_before_commit", "store_after_commit",
                                           "removal_rows_gone", "removal_half_way",
                                           "removal_files_gone"),
                         [](const auto& each) { return each.param; });

}  // namespace
}  // namespace breach::testing
