// What is computed once or again, and the reasons that the service gives.
#include <gtest/gtest.h>

#include <fstream>

#include "tests/faults/service_under_test.hpp"

namespace breach::testing::cache_test {
namespace {

using nlohmann::json;

int count_in_state(const json& run, const std::string& state) {
    int count = 0;
    for (const json& task : run.at("tasks")) count += task.at("state") == state ? 1 : 0;
    return count;
}

json why(Service& service, const json& run, const std::string& label) {
    const std::string id = task_labelled(run, label).at("id");
    return service.get("/v1/tasks/" + id).body.at("why");
}

TEST(Cache, EqualStudyIsAnsweredWithoutRunningAnything) {
    const Sandbox sandbox;
    Service service(sandbox);
    const json first = service.wait_for_end(service.submit(study("", {0.25, 0.5})));
    json renamed = study("", {0.25, 0.5});
    renamed["name"] = "another";
    renamed["scene"]["name"] = "other_name";
    renamed["resources"] = {{"mpm_solver", {{"cores", 2}}}};
    const json second = service.wait_for_end(service.submit(renamed));
    EXPECT_EQ(second.at("state"), "succeeded");
    EXPECT_EQ(count_in_state(second, "cached"), 6);
    EXPECT_EQ(second.at("tasks_done"), 6);
    json rows = service.table(second.at("id"));
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(rows[1].at("runout"), 10.25);
    EXPECT_EQ(rows[1].at("reused"), true);
    EXPECT_EQ(sandbox.successes().size(), 6u);
    const json task = task_labelled(second, "mpm_0.500000");
    EXPECT_EQ(task.at("same_as"), task_labelled(first, "mpm_0.500000").at("id"));
    EXPECT_EQ(task.at("artifacts"), task_labelled(first, "mpm_0.500000").at("artifacts"));
    EXPECT_TRUE(std::filesystem::exists(sandbox.data() / "runs" / second.at("id") /
                                        "mpm_0.500000/output/result.json"));
    EXPECT_EQ(why(service, second, "fem").at("reason"), "taken from an earlier task");
}

TEST(Cache, AnswersWhatEndedWhileAnEqualTaskWaited) {
    const Sandbox sandbox;
    Service service(sandbox, {"--slots", "1"});
    const std::string first = service.submit(study("mpm_steps=25", {0.25, 0.5, 0.75}));
    const auto state = [&](const char* label) {
        const json run = service.get("/v1/runs/" + first).body;
        return task_labelled(run, label).at("state").get<std::string>();
    };
    ASSERT_TRUE(eventually([&] { return state("mpm_0.500000") == "running"; }));
    // The cache lookup fails now: the first study completes it only later.
    const std::string second = service.submit(study("mpm_steps=25", {0.25, 0.5, 0.75}));
    ASSERT_EQ(service.wait_for_end(first).at("state"), "succeeded");
    const json end = service.wait_for_end(second);
    EXPECT_EQ(end.at("state"), "succeeded");
    EXPECT_EQ(count_in_state(end, "cached"), static_cast<int>(end.at("tasks").size()));
    EXPECT_EQ(sandbox.successes().size(), end.at("tasks").size());
}

TEST(Cache, EqualStudiesAtOnceAreComputedOnce) {
    const Sandbox sandbox;
    Service service(sandbox, {"--slots", "4"});
    std::vector<std::string> runs;
    for (int i = 0; i < 3; ++i)
        runs.push_back(service.submit(study("mpm_steps=10", {0.25, 0.5, 0.75})));
    std::size_t tasks = 0;
    for (const std::string& each : runs) {
        const json end = service.wait_for_end(each);
        EXPECT_EQ(end.at("state"), "succeeded");
        tasks = end.at("tasks").size();
    }
    EXPECT_EQ(sandbox.successes().size(), tasks);
}

TEST(Cache, AnswersWhatEndedWhileItWasLookedForInVain) {
    const Sandbox sandbox;
    const auto hold = sandbox.root() / "hold";
    std::ofstream(hold) << "\n";
    // Looks up the runout of 0.5 s in each study, as that of 0.25 s has its recipe.
    Service service(sandbox, {"--slots", "1"}, {"BREACHLINE_HOLD=reuse_none:2:" + hold.string()});
    const std::string first = service.submit(study("mpm_steps=60", {0.25, 0.5}));
    const auto state = [&](const std::string& run, const char* label) {
        return task_labelled(service.get("/v1/runs/" + run).body, label)
            .at("state")
            .get<std::string>();
    };
    ASSERT_TRUE(eventually([&] { return state(first, "mpm_0.500000") == "running"; }));
    const std::string second = service.submit(study("mpm_steps=60", {0.25, 0.5}));
    ASSERT_EQ(service.wait_for_end(first).at("state"), "succeeded");
    ASSERT_TRUE(eventually([&] { return state(second, "mpm_0.250000") == "cached"; }));
    std::filesystem::remove(hold);
    const json end = service.wait_for_end(second);
    EXPECT_EQ(count_in_state(end, "cached"), static_cast<int>(end.at("tasks").size()));
    EXPECT_EQ(sandbox.successes().size(), end.at("tasks").size());
}

TEST(Cache, ACancelledTaskLeavesTheWorkToTheEqualOneThatWaited) {
    const Sandbox sandbox;
    Service service(sandbox, {"--slots", "4"});
    const std::string first = service.submit(study("mpm_steps=3000", {0.5}));
    ASSERT_TRUE(eventually([&] {
        const json run = service.get("/v1/runs/" + first).body;
        return task_labelled(run, "mpm_0.500000").at("state") == "running";
    }));
    const std::string second = service.submit(study("mpm_steps=3000", {0.5}));
    const auto of_second = [&] {
        return task_labelled(service.get("/v1/runs/" + second).body, "mpm_0.500000");
    };
    ASSERT_TRUE(eventually([&] { return of_second().at("state") == "ready"; }));
    EXPECT_EQ(why(service, service.get("/v1/runs/" + second).body, "mpm_0.500000").at("reason"),
              "waits for an equal task");
    ASSERT_EQ(service.post("/v1/runs/" + first + "/cancel", "").status, 202);
    EXPECT_TRUE(eventually([&] { return of_second().at("state") == "running"; }));
    ASSERT_EQ(service.post("/v1/runs/" + second + "/cancel", "").status, 202);
}

TEST(Cache, ChangeOfTheMpmRunsTheMpmAloneAndSaysWhy) {
    const Sandbox sandbox;
    Service service(sandbox);
    const json first = service.wait_for_end(service.submit(study("", {0.25})));
    EXPECT_EQ(why(service, first, "fem").at("reason"), "first of its kind");
    json changed = study("", {0.25});
    changed["overrides"] = {"/mpm/duration=10"};
    const json second = service.wait_for_end(service.submit(changed));
    EXPECT_EQ(task_labelled(second, "fem").at("state"), "cached");
    EXPECT_EQ(task_labelled(second, "transfer_0.250000").at("state"), "cached");
    EXPECT_EQ(task_labelled(second, "mpm_0.250000").at("state"), "succeeded");
    const json reason = why(service, second, "mpm_0.250000");
    EXPECT_EQ(reason.at("reason"), "scene part changed");
    EXPECT_EQ(reason.at("differs"), json::parse(R"(["/mpm/duration"])"));
    EXPECT_EQ(reason.at("compared_with"), task_labelled(first, "mpm_0.250000").at("id"));
}

TEST(Cache, AlteredOrMissingOutputIsNeverServed) {
    for (const bool missing : {false, true}) {
        const Sandbox sandbox;
        Service service(sandbox);
        const std::string first = service.submit(study("", {0.25}));
        service.wait_for_end(first);
        const auto file = sandbox.data() / "runs" / first / "mpm_0.250000/output/result.json";
        if (missing) {
            std::filesystem::remove(file);
        } else {
            std::fstream(file, std::ios::in | std::ios::out) << "!";  // same size, another content
        }
        const json second = service.wait_for_end(service.submit(study("", {0.25})));
        EXPECT_EQ(task_labelled(second, "fem").at("state"), "cached");
        EXPECT_EQ(task_labelled(second, "mpm_0.250000").at("state"), "succeeded");
        const json reason = why(service, second, "mpm_0.250000");
        EXPECT_EQ(reason.at("reason"), "stored outputs are damaged");
        EXPECT_NE(reason.at("detail").get<std::string>().find("result.json"), std::string::npos);
        EXPECT_EQ(service.table(second.at("id"))[0].at("runout"), 10.0625);
    }
}

TEST(Cache, ResultsOfFailedTasksAreNotReused) {
    const Sandbox sandbox;
    Service service(sandbox, {"--tries", "1"});
    const json first = service.wait_for_end(service.submit(study("always_crash=1", {0.25})));
    EXPECT_EQ(task_labelled(first, "mpm_0.250000").at("state"), "failed");
    const json second = service.wait_for_end(service.submit(study("always_crash=1", {0.25})));
    EXPECT_EQ(task_labelled(second, "mpm_0.250000").at("state"), "failed");
    EXPECT_EQ(task_labelled(second, "mpm_0.250000").at("attempts").size(), 1u);
    EXPECT_EQ(why(service, second, "mpm_0.250000").at("reason"), "earlier task did not succeed");
}

TEST(Cache, AnEntangledFemIsAResultLikeAnyOther) {
    const Sandbox sandbox;
    Service service(sandbox);
    const json wanted = study("entangle_at=1", {0.25, 0.5, 2.0});
    const json first = service.wait_for_end(service.submit(wanted));
    EXPECT_EQ(task_labelled(first, "fem").at("state"), "succeeded");
    const json second = service.wait_for_end(service.submit(wanted));
    EXPECT_EQ(second.at("state"), "succeeded");
    EXPECT_EQ(task_labelled(second, "fem").at("state"), "cached");
    EXPECT_EQ(task_labelled(second, "mpm_0.500000").at("state"), "cached");
    EXPECT_EQ(task_labelled(second, "transfer_2.000000").at("not_reached"), true);
    const json rows = service.table(second.at("id"));
    EXPECT_EQ(rows[2].at("state"), "not_reached");
    EXPECT_EQ(rows[2].at("reason"), service.table(first.at("id"))[2].at("reason"));
}

TEST(Cache, ABreakdownBreaksDownAgainWithoutRunningAndARetryRunsIt) {
    const Sandbox sandbox;
    Service service(sandbox);
    const json wanted = study("breakdown_at=1", {0.25, 0.5, 2.0});
    const json first = service.wait_for_end(service.submit(wanted));
    ASSERT_EQ(task_labelled(first, "fem").at("state"), "failed");
    const json second = service.wait_for_end(service.submit(wanted));
    const json fem = task_labelled(second, "fem");
    EXPECT_EQ(fem.at("state"), "failed");
    EXPECT_EQ(fem.at("attempts").size(), 0u);
    EXPECT_EQ(fem.at("same_as"), task_labelled(first, "fem").at("id"));
    EXPECT_EQ(second.at("message"), first.at("message"));
    EXPECT_EQ(why(service, second, "fem").at("reason"), "taken from an earlier task");
    EXPECT_EQ(task_labelled(second, "mpm_0.500000").at("state"), "cached");
    EXPECT_EQ(task_labelled(second, "transfer_2.000000").at("state"), "skipped");
    const json rows = service.table(second.at("id")), earlier = service.table(first.at("id"));
    ASSERT_EQ(rows.size(), earlier.size());
    for (std::size_t i = 0; i < rows.size(); ++i)
        EXPECT_EQ(rows[i].at("runout"), earlier[i].at("runout"));

    const std::string id = second.at("id");
    EXPECT_EQ(service.post("/v1/runs/" + id + "/retry", "").status, 202);
    const json third = service.wait_for_end(id);
    EXPECT_EQ(task_labelled(third, "fem").at("state"), "failed");
    EXPECT_EQ(task_labelled(third, "fem").at("attempts").size(), 1u);
}

TEST(Cache, ABreakdownOfAnotherInputIsAnotherInput) {
    const Sandbox sandbox;
    Service service(sandbox, {"--slots", "1"});
    const json run = service.wait_for_end(service.submit(study("breaks_from=0", {0.25, 0.5})));
    ASSERT_EQ(task_labelled(run, "mpm_0.250000").at("state"), "failed");
    const json reason = why(service, run, "mpm_0.500000");
    EXPECT_EQ(reason.at("reason"), "input changed");
    EXPECT_EQ(reason.at("compared_with"), task_labelled(run, "mpm_0.250000").at("id"));
}

TEST(Cache, IsNotAskedWhenTheStudySaysSo) {
    const Sandbox sandbox;
    Service service(sandbox);
    service.wait_for_end(service.submit(study("", {0.25})));
    json again = study("", {0.25});
    again["reuse"] = false;
    const json second = service.wait_for_end(service.submit(again));
    EXPECT_EQ(count_in_state(second, "cached"), 0);
    EXPECT_EQ(why(service, second, "fem").at("reason"), "reuse is switched off");
}

TEST(Variants, ShareWhatDoesNotDiffer) {
    const Sandbox sandbox;
    Service service(sandbox);
    json wanted = study("", {0.25, 0.5});
    wanted["variants"] = {{{"name", "long"}},
                          {{"name", "short"}, {"overrides", {"/mpm/duration=5"}}},
                          {{"name", "weak"}, {"overrides", {"/materials/slope_soil/law/c_kPa=9"}}}};
    const json run = service.wait_for_end(service.submit(wanted));
    ASSERT_EQ(run.at("state"), "succeeded") << run.at("message");
    // long and short: one FEM, two transfers; weak: the same; and each its LEM and two runouts.
    EXPECT_EQ(run.at("tasks").size(), 2u * 3u + 3u * 3u);
    EXPECT_EQ(task_labelled(run, "lem_short").at("state"), "cached") << "it is that of long";
    EXPECT_EQ(task_labelled(run, "mpm_0.250000_short").at("variant"), "short");
    const json rows = service.table(run.at("id"));
    ASSERT_EQ(rows.size(), 6u);
    EXPECT_EQ(rows[0].at("variant"), "long");
    EXPECT_EQ(rows[5].at("variant"), "weak");
    EXPECT_EQ(rows[5].at("transfer_time"), 0.5);
    for (const json& row : rows) EXPECT_EQ(row.at("state"), "succeeded") << row;
}

TEST(Variants, OfSoilThatOnlyTheRunoutKnowsShareTheFem) {
    const Sandbox sandbox;
    Service service(sandbox);
    json wanted = study("", {0.25});
    wanted["scene"]["materials"]["debris"] = wanted["scene"]["materials"]["slope_soil"];
    wanted["variants"] = {{{"name", "plain"}},
                          {{"name", "weak"}, {"overrides", {"/materials/debris/law/c_kPa=9"}}},
                          {{"name", "coarse"}, {"overrides", {"/mpm/cell_size=2"}}}};
    const json run = service.wait_for_end(service.submit(wanted));
    ASSERT_EQ(run.at("state"), "succeeded") << run.at("message");
    // One FEM, one LEM; soil mapping and grid belong to the transfer: three of them.
    EXPECT_EQ(run.at("tasks").size(), 2u + 3u + 3u);
}

TEST(Variants, FaultsNameTheVariant) {
    const Sandbox sandbox;
    Service service(sandbox);
    json wanted = study("", {0.25});
    wanted["variants"] = {{{"name", "a"}, {"overrides", {"/mpm/cell_size=-1"}}}, {{"name", "a"}}};
    const Answer answer = service.post("/v1/runs", wanted.dump());
    EXPECT_EQ(answer.status, 422);
    std::string pointers;
    for (const json& each : answer.body.at("faults"))
        pointers += each.at("pointer").get<std::string>() + " ";
    EXPECT_NE(pointers.find("/variants/0/overrides"), std::string::npos) << pointers;
    EXPECT_NE(pointers.find("/variants/1/name"), std::string::npos) << pointers;
}

}  // namespace
}  // namespace breach::testing::cache_test
