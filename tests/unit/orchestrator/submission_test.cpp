// Repeated submissions count once, and runs are found again.
#include <gtest/gtest.h>

#include <atomic>
#include <fstream>
#include <set>
#include <thread>

#include "core/exchange/archive.hpp"
#include "tests/faults/service_under_test.hpp"

namespace breach::testing::submission_test {
namespace {

using nlohmann::json;

Answer post_with_key(Service& service, const std::string& key, const json& body) {
    return service.post("/v1/runs", body.dump(), "application/json", {{"Idempotency-Key", key}});
}

std::size_t runs_in(Service& service) {
    return service.get("/v1/runs?limit=500").body.at("runs").size();
}

TEST(IdempotencyKey, SameBodyGivesTheSameRunAndAnotherBodyIsRefused) {
    const Sandbox sandbox;
    Service service(sandbox);
    const Answer first = post_with_key(service, "key-1", study("", {0.25}));
    ASSERT_EQ(first.status, 202) << first.text;
    const Answer again = post_with_key(service, "key-1", study("", {0.25}));
    EXPECT_EQ(again.status, 202);
    EXPECT_EQ(again.body.at("id"), first.body.at("id"));
    EXPECT_EQ(again.headers.find("Location")->second, first.headers.find("Location")->second);
    EXPECT_EQ(again.headers.find("Idempotent-Replayed")->second, "true");
    const Answer other = post_with_key(service, "key-1", study("", {0.5}));
    EXPECT_EQ(other.status, 422);
    EXPECT_EQ(other.body.at("type"), "/problems/idempotency-key-reused");
    EXPECT_EQ(runs_in(service), 1u);
    EXPECT_EQ(post_with_key(service, std::string(300, 'k'), study("", {0.5})).status, 400);
    EXPECT_EQ(post_with_key(service, "two words", study("", {0.5})).status, 400);
}

TEST(IdempotencyKey, RefusedStudyDoesNotUseItsKeyUp) {
    const Sandbox sandbox;
    Service service(sandbox);
    EXPECT_EQ(post_with_key(service, "key", {{"name", "bad"}}).status, 422);
    EXPECT_EQ(post_with_key(service, "key", study("", {0.25})).status, 202);
}

TEST(IdempotencyKey, SurvivesTheServicesDeath) {
    const Sandbox sandbox;
    std::string run;
    {
        Service first(sandbox);
        run = post_with_key(first, "key", study("fem_steps=500", {0.25})).body.at("id");
        first.kill_at_once();
    }
    Service second(sandbox);
    ASSERT_TRUE(second.valid()) << second.complaint();
    const Answer again = post_with_key(second, "key", study("fem_steps=500", {0.25}));
    EXPECT_EQ(again.status, 202);
    EXPECT_EQ(again.body.at("id"), run);
    EXPECT_EQ(post_with_key(second, "key", study("", {0.5})).status, 422);
    second.post("/v1/runs/" + run + "/cancel", "");
}

TEST(IdempotencyKey, FiftyAtOnceMakeOneRun) {
    const Sandbox sandbox;
    Service service(sandbox);
    std::atomic<int> accepted = 0;
    std::atomic<int> in_progress = 0;
    std::atomic<int> others = 0;
    {
        std::vector<std::jthread> clients;
        for (int i = 0; i < 50; ++i) {
            clients.emplace_back([&] {
                const int status = post_with_key(service, "one", study("", {0.25})).status;
                ++(status == 202 ? accepted : status == 409 ? in_progress : others);
            });
        }
    }
    EXPECT_GE(accepted, 1);
    EXPECT_EQ(others, 0);
    EXPECT_EQ(accepted + in_progress, 50);
    EXPECT_EQ(runs_in(service), 1u);
}

TEST(ListOfRuns, PagesShowEveryRunOnceNewestFirst) {
    const Sandbox sandbox;
    Service service(sandbox);
    std::vector<std::string> submitted;
    for (int i = 0; i < 7; ++i) submitted.push_back(service.submit(study("", {0.25})));
    std::vector<std::string> listed;
    std::string path = "/v1/runs?limit=3";
    for (int pages = 0; pages < 4; ++pages) {
        const json page = service.get(path).body;
        for (const json& run : page.at("runs")) listed.push_back(run.at("id"));
        if (page.at("next").is_null()) break;
        path = "/v1/runs?limit=3&cursor=" + page.at("next").get<std::string>();
    }
    EXPECT_EQ(std::set<std::string>(listed.begin(), listed.end()).size(), 7u);
    EXPECT_EQ(listed.size(), 7u);
    EXPECT_EQ(listed.front(), submitted.back());
    EXPECT_EQ(service.get("/v1/runs?cursor=nonsense").status, 400);
}

TEST(ListOfRuns, IsFilteredByStateAndName) {
    const Sandbox sandbox;
    Service service(sandbox);
    const std::string good = service.submit(study("", {0.25}));
    json named = study("breakdown_at=0.1", {1.0});
    named["name"] = "broken";
    const std::string bad = service.submit(named);
    service.wait_for_end(good);
    service.wait_for_end(bad);
    const auto ids = [&](const std::string& query) {
        std::vector<std::string> found;
        const json list = service.get("/v1/runs?" + query).body.at("runs");
        for (const json& run : list) found.push_back(run.at("id"));
        return found;
    };
    EXPECT_EQ(ids("state=succeeded"), std::vector<std::string>{good});
    EXPECT_EQ(ids("state=failed"), std::vector<std::string>{bad});
    EXPECT_EQ(ids("name=broken"), std::vector<std::string>{bad});
    EXPECT_TRUE(ids("state=running").empty());
    EXPECT_TRUE(ids("state=succeeded&name=broken").empty());
    EXPECT_EQ(service.get("/v1/runs?state=happy").status, 400);
    EXPECT_EQ(service.get("/v1/runs?colour=red").status, 400);
}

std::vector<std::string> of_rows(const json& rows, const char* key) {
    std::vector<std::string> found;
    for (const json& row : rows) found.push_back(row.at(key));
    return found;
}

TEST(ResultsThatMove, AreQuestionableWhereverTheyAreShown) {
    const Sandbox sandbox;
    Service service(sandbox);
    const std::string run = service.submit(study("moving_from=0.5", {0.25, 0.5, 0.75}));
    const json ended = service.wait_for_end(run);
    EXPECT_EQ(ended.at("state"), "questionable");
    EXPECT_EQ(ended.at("questionable"), 2);
    EXPECT_EQ(ended.at("message"),
              "3 of 3 runouts flagged implausible; 2 of 3 runouts still moving: lower bounds");
    EXPECT_EQ(ended.at("flag_counts"), json({{"still_moving", 2}, {"implausible", 3}}));
    const json task = task_labelled(ended, "mpm_0.500000");
    EXPECT_EQ(task.at("state"), "succeeded");  // what the lifecycle says
    EXPECT_EQ(task.at("questionable"), true);
    EXPECT_EQ(task.at("ended"), "duration");
    EXPECT_EQ(task.at("flags").size(), 2u);
    EXPECT_TRUE(task_labelled(ended, "fem").at("flags").is_null());  // the fake FEM has no flags

    const std::string path = "/v1/runs/" + run + "/results";
    const json rows = service.get(path).body.at("rows");
    EXPECT_EQ(of_rows(rows, "state"),
              (std::vector<std::string>{"succeeded", "questionable", "questionable"}));
    EXPECT_EQ(rows[0].at("questionable"), false);
    EXPECT_EQ(rows[1].at("at_rest"), false);
    EXPECT_EQ(rows[1].at("flags")[0].at("pointer"), "/mpm/duration");
    const std::string csv = service.get(path + "?format=csv").text;
    EXPECT_NE(csv.find("0.5,\"questionable\","), std::string::npos) << csv;
    EXPECT_NE(csv.find(",true,\"still_moving;implausible\",0.5,\"usual scatter"), std::string::npos)
        << csv;
    EXPECT_EQ(service.get(path + "?state=questionable").body.at("rows").size(), 2u);
    EXPECT_EQ(service.get(path + "?flag=implausible&from=2").body.at("rows").size(), 1u);
    EXPECT_TRUE(service.get(path + "?flag=moving").body.at("rows").empty());
    EXPECT_EQ(service.get(path + "?state=happy").status, 400);
    EXPECT_EQ(service.get("/v1/runs?state=questionable").body.at("runs").size(), 1u);
    EXPECT_TRUE(service.get("/v1/runs?state=succeeded").body.at("runs").empty());
}

TEST(Variants, KeepTheStudysOrderInEveryTable) {
    const Sandbox sandbox;
    Service service(sandbox);
    json wanted = study("", {0.25, 0.5});
    wanted["variants"] = {{{"name", "weak"}},
                          {{"name", "medium"}, {"overrides", {"/mpm/duration=5"}}},
                          {{"name", "strong"}, {"overrides", {"/mpm/duration=6"}}}};
    const std::string run = service.submit(wanted);
    service.wait_for_end(run);
    const std::vector<std::string> order{"weak", "weak", "medium", "medium", "strong", "strong"};
    const std::string path = "/v1/runs/" + run + "/results";
    EXPECT_EQ(of_rows(service.get(path).body.at("rows"), "variant"), order);
    EXPECT_EQ(of_rows(service.get(path + "?from=1&limit=2").body.at("rows"), "variant"),
              (std::vector<std::string>{"weak", "medium"}));
    const std::string csv = service.get(path + "?format=csv").text;
    EXPECT_LT(csv.find("\"weak\""), csv.find("\"medium\""));
    EXPECT_LT(csv.find("\"medium\""), csv.find("\"strong\""));

    const auto file = sandbox.root() / "results.h5";
    std::ofstream(file, std::ios::binary) << service.get(path + "?format=hdf5").text;
    const auto archive = exchange::read_archive(file, "sweep_results", 1);
    EXPECT_EQ(archive.texts.at("variant"), "weak\nweak\nmedium\nmedium\nstrong\nstrong\n");
    EXPECT_EQ(archive.integers.at("questionable"), std::vector<std::int64_t>(6, 0));
    EXPECT_EQ(archive.units.at("runout"), "m");
}

TEST(Submission, TakesASceneForWhatItIs) {
    const Sandbox sandbox;
    Service service(sandbox);
    const json scene = study("", {0.25}).at("scene");
    const json faults = service.post("/v1/runs", scene.dump()).body.at("faults");
    ASSERT_EQ(faults.size(), 1u) << faults;
    EXPECT_NE(faults[0].at("cause").get<std::string>().find("a scene, not a study"),
              std::string::npos);
    EXPECT_NE(faults[0].at("remedy").get<std::string>().find("breach submit --scene"),
              std::string::npos);
    const json other = service.post("/v1/scenes/plan", study("", {0.25}).dump()).body.at("faults");
    ASSERT_EQ(other.size(), 1u) << other;
    EXPECT_NE(other[0].at("cause").get<std::string>().find("a study, not a scene"),
              std::string::npos);
}

TEST(Submission, SaysWhereAFileIsLookedFor) {
    const Sandbox sandbox;
    Service service(sandbox);
    json wanted = study("", {0.25});
    wanted["scene"]["fem"]["motion"] = {{"file", "/home/somebody/motion.txt"}};
    const json faults = service.post("/v1/runs", wanted.dump()).body.at("faults");
    bool told = false;
    for (const json& each : faults)
        told |= each.at("pointer") == "/scene/fem/motion/file" &&
                each.at("remedy").get<std::string>().find("copy it there") != std::string::npos;
    EXPECT_TRUE(told) << faults;
}

TEST(Sweeps, AreRunsSeenAsTables) {
    const Sandbox sandbox;
    Service service(sandbox);
    const std::string single = service.submit(study("", {0.25}));
    json wanted = study("", {0.25, 0.5});
    wanted["variants"] = {{{"name", "a"}}, {{"name", "b"}, {"overrides", {"/mpm/duration=5"}}}};
    const Answer accepted = service.post("/v1/sweeps", wanted.dump());
    ASSERT_EQ(accepted.status, 202) << accepted.text;
    const std::string id = accepted.body.at("id");
    EXPECT_EQ(accepted.headers.find("Location")->second, "/v1/sweeps/" + id);
    EXPECT_EQ(accepted.body.at("points_total"), 4);
    service.wait_for_end(id);
    const json sweep = service.get("/v1/sweeps/" + id).body;
    EXPECT_EQ(sweep.at("state"), "succeeded");
    EXPECT_EQ(sweep.at("points_done"), 4);
    EXPECT_EQ(sweep.at("variants").size(), 2u);
    const json list = service.get("/v1/sweeps").body.at("sweeps");
    ASSERT_EQ(list.size(), 1u);  // not the single run
    EXPECT_EQ(list[0].at("id"), id);
    EXPECT_EQ(service.get("/v1/sweeps/" + id + "/results").body.at("rows").size(), 4u);
    const std::string csv = service.get("/v1/sweeps/" + id + "/results?format=csv").text;
    EXPECT_NE(csv.find("numerical_share,overlap,cpu_seconds"), std::string::npos) << csv;
    EXPECT_EQ(service.post("/v1/sweeps/" + id + "/cancel", "").status, 202);
    EXPECT_EQ(service.get("/v1/sweeps/nobody").status, 404);
}

TEST(Examples, AreStudiesThatCanBeSentAsTheyAre) {
    const Sandbox sandbox;
    Service service(sandbox);
    const json examples = service.get("/v1/examples").body.at("examples");
    ASSERT_FALSE(examples.empty());
    for (const json& each : examples) {
        const std::string name = each.at("name");
        const Answer whole = service.get("/v1/examples/" + name);
        ASSERT_EQ(whole.status, 200) << name;
        EXPECT_TRUE(whole.body.at("scene").is_object()) << name;
        const Answer accepted = service.post("/v1/runs", whole.text);
        EXPECT_EQ(accepted.status, 202) << name << " " << accepted.text;
    }
    EXPECT_EQ(service.get("/v1/examples/none").status, 404);
}

}  // namespace
}  // namespace breach::testing::submission_test
