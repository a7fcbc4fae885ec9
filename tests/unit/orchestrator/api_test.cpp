// The HTTP API of a real service with fake phases.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <fstream>
#include <set>

#include "tests/faults/service_under_test.hpp"

namespace breach::testing::api_test {
namespace {

using nlohmann::json;

/// Sends raw bytes and returns the first line of the answer.
std::string raw(int port, const std::string& bytes) {
    const int descriptor = socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    std::string answer;
    if (connect(descriptor, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0 &&
        send(descriptor, bytes.data(), bytes.size(), MSG_NOSIGNAL) > 0) {
        char buffer[1024];
        ssize_t size = 0;
        while (answer.find("\r\n") == std::string::npos &&
               (size = recv(descriptor, buffer, sizeof buffer, 0)) > 0)
            answer.append(buffer, static_cast<std::size_t>(size));
    }
    close(descriptor);
    return answer.substr(0, answer.find("\r\n"));
}

/// One service for all tests that change little.
class Api : public ::testing::Test {
  protected:
    static void SetUpTestSuite() {
        sandbox = std::make_unique<Sandbox>();
        std::filesystem::create_directories(sandbox->root() / "web");
        std::ofstream(sandbox->root() / "web/index.html") << "<p>dashboard</p>";
        std::ofstream(sandbox->root() / "secret.txt") << "secret";
        std::filesystem::create_symlink(sandbox->root() / "secret.txt",
                                        sandbox->root() / "web/link.txt");
        service = std::make_unique<Service>(
            *sandbox, std::vector<std::string>{"--web", sandbox->root() / "web"});
        run = service->submit(study("", {0.25, 0.5}));
        ended = service->wait_for_end(run);
    }
    static void TearDownTestSuite() {
        service.reset();
        sandbox.reset();
    }
    static std::string task(const std::string& label) {
        for (const json& each : ended.at("tasks")) {
            if (each.at("label") == label) return each.at("id");
        }
        return "";
    }

    static std::unique_ptr<Sandbox> sandbox;
    static std::unique_ptr<Service> service;
    static std::string run;
    static json ended;
};
std::unique_ptr<Sandbox> Api::sandbox;
std::unique_ptr<Service> Api::service;
std::string Api::run;
json Api::ended;

TEST_F(Api, RunIsAcceptedWithItsLocationAndEndsWithItsTable) {
    const Answer accepted = service->post("/v1/runs", study("", {0.25}).dump());
    ASSERT_EQ(accepted.status, 202);
    const std::string id = accepted.body.at("id");
    EXPECT_EQ(accepted.headers.find("Location")->second, "/v1/runs/" + id);
    EXPECT_EQ(accepted.body.at("tasks_total"), 4);
    const json end = service->wait_for_end(id);
    EXPECT_EQ(end.at("state"), "succeeded");
    EXPECT_EQ(end.at("progress"), 1.0);
    const json rows = service->table(id);
    ASSERT_EQ(rows.size(), 1u);
    EXPECT_EQ(rows[0].at("runout"), 10.0625);
    EXPECT_EQ(rows[0].at("numerical_share"), 0.01);
    const json list = service->get("/v1/runs").body.at("runs");
    EXPECT_EQ(list.at(0).at("id"), id);  // newest first
}

TEST_F(Api, BadSceneIsAnsweredWithEveryFaultAndItsPointer) {
    json bad = study("", {0.25});
    bad["scene"]["materials"]["slope_soil"]["density"] = -1;
    bad["scene"]["section"]["regions"][0]["material"] = "chalk";
    bad["scene"]["gravty"] = 9.81;
    const Answer answer = service->post("/v1/runs", bad.dump());
    EXPECT_EQ(answer.status, 422);
    EXPECT_EQ(answer.headers.find("Content-Type")->second, "application/problem+json");
    EXPECT_EQ(answer.body.at("type"), "/problems/bad-input");
    std::set<std::string> pointers;
    for (const json& each : answer.body.at("faults")) {
        pointers.insert(each.at("pointer"));
        EXPECT_FALSE(each.at("cause").get<std::string>().empty());
        EXPECT_FALSE(each.at("remedy").get<std::string>().empty());
    }
    EXPECT_TRUE(pointers.contains("/scene/materials/slope_soil/density"));
    EXPECT_TRUE(pointers.contains("/scene/section/regions/0/material"));
    EXPECT_TRUE(pointers.contains("/scene/gravty"));
}

TEST_F(Api, WhatOnlyALaterPhaseWouldMeetIsRefusedWithEverythingElse) {
    json bad = study("", {0.25, 99.0});
    bad["scene"]["mpm"]["runout"]["toe"] = {500, 0};
    bad["scene"]["lem"]["search"]["exit"] = {200, 300};
    bad["variants"] = json::array(
        {{{"name", "sound"}, {"overrides", {"/mpm/cfl=0.3"}}},
         {{"name", "hung"},
          {"overrides", {"/fem/supports/2/from=[0,-8]", "/fem/supports/2/to=[60,-8]"}}}});
    const Answer answer = service->post("/v1/runs", bad.dump());
    ASSERT_EQ(answer.status, 422);
    std::set<std::string> pointers;
    for (const json& each : answer.body.at("faults")) pointers.insert(each.at("pointer"));
    EXPECT_TRUE(pointers.contains("/transfer_times")) << answer.text;
    EXPECT_TRUE(pointers.contains("/scene/mpm/runout/toe")) << answer.text;
    EXPECT_TRUE(pointers.contains("/scene/lem/search/exit")) << answer.text;
    EXPECT_TRUE(pointers.contains("/variants/1/overrides")) << answer.text;
    const Answer plan = service->post("/v1/scenes/plan", bad["scene"].dump());
    ASSERT_EQ(plan.status, 422);
    EXPECT_EQ(plan.body.at("faults").size(), 2u) << plan.text;
}

TEST_F(Api, TextThatIsNotSoundJsonIsRefused) {
    for (const std::string body :
         {"", "{", "[]", "nonsense", "{\"name\":1,\"name\":2}", "{\"a\":1e400}", "\xff\xfe"}) {
        const Answer answer = service->post("/v1/runs", body);
        EXPECT_EQ(answer.status, 422) << body;
        EXPECT_FALSE(answer.body.at("faults").empty()) << body;
    }
    EXPECT_EQ(service->post("/v1/runs", std::string(100000, '[')).status, 422);
    EXPECT_EQ(service->post("/v1/runs", "{}", "text/plain").status, 415);
}

TEST_F(Api, WhatIsNotThereIs404AndWrongMethodsAre405) {
    for (const std::string path :
         {"/v1/runs/nobody", "/v1/tasks/nobody", "/v1/artifacts/00", "/v1/nothing",
          "/v1/runs/nobody/results", "/v1/runs/nobody/telemetry", "/static/none.js"}) {
        const Answer answer = service->get(path);
        EXPECT_EQ(answer.status, 404) << path;
        EXPECT_EQ(answer.body.at("type"), "/problems/not-found") << path;
    }
    EXPECT_EQ(service->post("/v1/runs/nobody/cancel", "").status, 404);
    const Answer wrong = service->ask("DELETE", "/v1/runs");
    EXPECT_EQ(wrong.status, 405);
    EXPECT_EQ(wrong.headers.find("Allow")->second, "POST, GET");
    EXPECT_EQ(service->ask("PUT", "/v1/runs/" + run).status, 405);
}

TEST_F(Api, UnknownOrMisspeltFiltersAre400) {
    EXPECT_EQ(service->get("/v1/runs?stat=running").status, 400);
    EXPECT_EQ(service->get("/v1/runs?limit=-1").status, 400);
    EXPECT_EQ(service->get("/v1/runs?limit=ten").status, 400);
    EXPECT_EQ(service->get("/v1/runs/" + run + "/results?format=xls").status, 400);
    EXPECT_EQ(service->get("/v1/runs/" + run + "/telemetry?phase=mpm_solver").status,
              400);  // two of them
}

TEST_F(Api, OversizedBodyIs413) {
    const std::string body = "{\"name\":\"" + std::string(17 << 20, 'x') + "\"}";
    const Answer answer = service->post("/v1/runs", body);
    EXPECT_EQ(answer.status, 413);
    EXPECT_EQ(service->get("/healthz").status, 200);
}

TEST_F(Api, ARefusalIsSmallHoweverManyFaultsThereAre) {
    json keys = study("", {0.25});
    for (int i = 0; i < 5000; ++i) keys["scene"]["key" + std::to_string(i)] = 1;
    json regions = study("", {0.25});
    for (int i = 0; i < 300; ++i) {
        regions["scene"]["section"]["regions"].push_back(regions["scene"]["section"]["regions"][0]);
        regions["scene"]["section"]["regions"].back()["material"] = std::string(2000, '"');
    }
    json variants = study("", {0.25});
    for (int i = 0; i < 300; ++i)
        variants["variants"].push_back(
            {{"name", "v" + std::to_string(i)}, {"overrides", {"/mpm/nonsense=1"}}});
    for (const json& each : {keys, regions, variants}) {
        const Answer answer = service->post("/v1/runs", each.dump());
        EXPECT_EQ(answer.status, 422);
        EXPECT_LT(answer.text.size(), 100'000u);
        EXPECT_LE(answer.body.at("faults").size(), 100u);
        EXPECT_GE(answer.body.at("faults").size(), 30u);
        EXPECT_NE(answer.body.at("detail").get<std::string>().find("of which these are the first"),
                  std::string::npos)
            << answer.body.at("detail");
    }
}

TEST_F(Api, DoubtfulRequestsAreRefused) {
    const int port = service->port();
    const std::string host = "Host: 127.0.0.1\r\n";
    EXPECT_EQ(raw(port, "POST /v1/runs HTTP/1.1\r\n" + host +
                            "Content-Length: 2\r\nTransfer-Encoding: chunked\r\n\r\n{}"),
              "HTTP/1.1 400 Bad Request");
    EXPECT_EQ(raw(port, "POST /v1/runs HTTP/1.1\r\n" + host +
                            "Content-Length: 2\r\nContent-Length: 3\r\n\r\n{}"),
              "HTTP/1.1 400 Bad Request");
    std::string many;
    for (int i = 0; i < 70; ++i) many += "X-" + std::to_string(i) + ": 1\r\n";
    EXPECT_EQ(raw(port, "GET /v1/runs HTTP/1.1\r\n" + host + many + "\r\n").substr(0, 12),
              "HTTP/1.1 431");
    EXPECT_EQ(raw(port, "GET /v1/runs HTTP/1.1\r\n" + host + "Range: bytes=0-1,2-3\r\n\r\n")
                  .substr(0, 12),
              "HTTP/1.1 416");
    EXPECT_EQ(raw(port, "GET /v1/runs HTTP/1.1\r\n" + host + "Origin: http://evil.example\r\n\r\n")
                  .substr(0, 12),
              "HTTP/1.1 403");
}

// A page of the first name, which resolves to 127.0.0.1, has the same origin as the service.
TEST_F(Api, OnlyAddressesOfLoopbackAreAnsweredWithoutAToken) {
    const auto status = [](const std::string& host) {
        return raw(service->port(), "GET /v1/runs HTTP/1.1\r\nHost: " + host +
                                        "\r\nOrigin: http://" + host + "\r\n\r\n")
            .substr(0, 12);
    };
    for (const char* foreign : {"127.attacker.example:8611", "localhost.attacker.example",
                                "evil.example", "localhost:80@evil.example", ""})
        EXPECT_EQ(status(foreign), "HTTP/1.1 421") << foreign;
    for (const char* own : {"localhost", "LOCALHOST.:8470", "127.0.0.1:1", "[::1]:8470"})
        EXPECT_EQ(status(own), "HTTP/1.1 200") << own;
}

TEST_F(Api, PagesStayInsideTheirFolder) {
    EXPECT_EQ(service->get("/").text, "<p>dashboard</p>");
    for (const std::string path :
         {"/static/../secret.txt", "/static/..%2fsecret.txt", "/static/%2e%2e/secret.txt",
          "/static//etc/passwd", "/static/link.txt", "/static/.hidden", "/static/%00",
          "/../secret.txt"}) {
        EXPECT_EQ(raw(service->port(), "GET " + path + " HTTP/1.1\r\nHost: localhost\r\n\r\n")
                      .substr(0, 12),
                  "HTTP/1.1 404")
            << path;
    }
    EXPECT_EQ(service->get("/static/" + std::string(3000, 'a')).status, 404);
}

TEST_F(Api, ArtifactsCarryTheirHashAndComeInOnePart) {
    const Answer task_answer = service->get("/v1/tasks/" + task("mpm_0.250000"));
    ASSERT_EQ(task_answer.status, 200);
    const json artifacts = task_answer.body.at("artifacts");
    const auto result = std::find_if(artifacts.begin(), artifacts.end(), [](const json& each) {
        return each.at("name") == "result.json";
    });
    ASSERT_NE(result, artifacts.end());
    const std::string path = "/v1/artifacts/" + result->at("sha256").get<std::string>();
    const Answer whole = service->get(path);
    EXPECT_EQ(whole.status, 200);
    EXPECT_EQ(whole.text.size(), result->at("bytes"));
    EXPECT_EQ(whole.body.at("runout"), 10.0625);
    EXPECT_EQ(service->get(path, {{"If-None-Match", whole.headers.find("ETag")->second}}).status,
              304);
    const Answer part = service->get(path, {{"Range", "bytes=2-5"}});
    EXPECT_EQ(part.status, 206);
    EXPECT_EQ(part.text, whole.text.substr(2, 4));
    EXPECT_EQ(service->get(path, {{"Range", "bytes=-3"}}).text,
              whole.text.substr(whole.text.size() - 3));
    EXPECT_EQ(service->get(path, {{"Range", "bytes=5-999999999"}}).text, whole.text.substr(5));
    EXPECT_EQ(service->get(path, {{"Range", "bytes=99999999-"}}).status, 416);
    EXPECT_EQ(service->get(path, {{"Range", "bytes=0-1,3-4"}}).status, 416);
}

TEST_F(Api, LogIsReadFromAnOffset) {
    const std::string path = "/v1/tasks/" + task("fem") + "/attempts/1/log";
    const Answer log = service->get(path);
    EXPECT_EQ(log.text, "fem_solver begins\n");
    const std::string next = log.headers.find("X-Next-Offset")->second;
    EXPECT_EQ(next, "18");
    EXPECT_EQ(service->get(path + "?offset=" + next).text, "");
    EXPECT_EQ(service->get(path + "?offset=11").text, "begins\n");
    EXPECT_EQ(service->get("/v1/tasks/" + task("fem") + "/attempts/7/log").status, 404);
}

TEST_F(Api, TelemetryIsThinnedAndContinued) {
    const std::string path = "/v1/runs/" + run + "/telemetry?phase=fem_solver";
    const json all = service->get(path).body;
    ASSERT_EQ(all.at("lines").size(), 10u);
    EXPECT_EQ(all.at("next"), 10);
    const json some = service->get(path + "&fields=speed&from=4&stride=3").body;
    EXPECT_EQ(some.at("lines"), json::parse(R"([{"speed":3.0},{"speed":4.5}])"));
    EXPECT_EQ(service->get("/v1/runs/" + run + "/telemetry?phase=mpm_solver&transfer_time=0.5")
                  .body.at("lines")
                  .size(),
              5u);
}

TEST_F(Api, FramesAreListedAndADamagedOneIsRefused) {
    const json frames = service->get("/v1/tasks/" + task("fem") + "/frames").body.at("frames");
    ASSERT_EQ(frames.size(), 2u);
    EXPECT_EQ(frames[0].at("name"), "snapshot_0.250000.vtkhdf");
    EXPECT_EQ(frames[0].at("time"), 0.25);
    EXPECT_EQ(frames[0].at("kind"), "mesh");
    EXPECT_EQ(frames[0].at("sha256").get<std::string>().size(), 64u);
    const std::string base = "/v1/tasks/" + task("fem") + "/frames/";
    EXPECT_EQ(service->get(base + std::string(300, 'a') + ".vtkhdf/points").status, 404);
    const int damaged = service->get(base + "snapshot_0.250000.vtkhdf/points")
                            .status;  // the fakes write plain text
    EXPECT_TRUE(damaged == 410 || damaged == 422) << damaged;
    EXPECT_EQ(service->get(base + "snapshot_9.000000.vtkhdf/points").status, 404);
    EXPECT_EQ(service->get(base + "..%2f..%2fscene.json/points").status, 404);
}

TEST_F(Api, EventsAreContinuedFromWhereTheReaderWas) {
    const json first = service->get("/v1/events?after=0").body;
    ASSERT_FALSE(first.at("events").empty());
    EXPECT_EQ(first.at("events")[0].at("kind"), "run");
    std::int64_t seq = 0;
    for (const json& each : first.at("events")) {
        EXPECT_GT(each.at("seq"), seq);
        seq = each.at("seq");
    }
    std::int64_t after = seq;
    for (json page;
         (page = service->get("/v1/events?after=" + std::to_string(after)).body).at("next") !=
         after;)
        after = page.at("next");
    const json none = service->get("/v1/events?after=" + std::to_string(after) + "&wait=1").body;
    EXPECT_TRUE(none.at("events").empty());
    EXPECT_EQ(none.at("next"), after);
    EXPECT_EQ(none.at("reset"), false);
    // a client that knows a later event than the service, e.g. after a backup was restored
    const json beyond =
        service->get("/v1/events?after=" + std::to_string(after + 1) + "&wait=30").body;
    EXPECT_EQ(beyond, json({{"events", json::array()}, {"next", after}, {"reset", true}}));
}

TEST_F(Api, PlansAndSchemasAreAnswered) {
    const Answer plan = service->post("/v1/scenes/plan", study("", {0.25}).at("scene").dump());
    ASSERT_EQ(plan.status, 200) << plan.text;
    EXPECT_EQ(plan.body.at("plans").at("fem_solver"), "the fake fem_solver needs nothing\n");
    EXPECT_EQ(plan.body.at("plans").size(), 4u);
    EXPECT_EQ(service->post("/v1/scenes/plan", "{}").status, 422);
    EXPECT_EQ(service->get("/v1/schema/study").body.at("title"), "Breachline study");
    EXPECT_EQ(service->get("/readyz").status, 200);
}

TEST_F(Api, ResultsComeAsCsvToo) {
    const Answer csv = service->get("/v1/runs/" + run + "/results?format=csv");
    EXPECT_TRUE(csv.text.starts_with("transfer_time,state,runout,")) << csv.text;
    EXPECT_NE(csv.text.find("0.25,\"succeeded\",10.0625,"), std::string::npos) << csv.text;
}

TEST(ApiAccess, TokenIsNeededWhenThereIsOne) {
    const Sandbox sandbox;
    std::ofstream(sandbox.root() / "token") << "correct-horse-battery\n";
    Service service(sandbox, {"--token-file", sandbox.root() / "token"});
    ASSERT_TRUE(service.valid());
    EXPECT_EQ(service.get("/v1/runs").status, 401);
    EXPECT_EQ(service.get("/v1/runs", {{"Authorization", "Bearer correct-horse-batterz"}}).status,
              401);
    for (const std::string scheme : {"Bearer ", "bearer ", "BEARER  "})
        EXPECT_EQ(
            service.get("/v1/runs", {{"Authorization", scheme + "correct-horse-battery"}}).status,
            200)
            << scheme;
    EXPECT_EQ(service.get("/v1/runs", {{"Authorization", "bearer"}}).status, 401);
    EXPECT_EQ(service.get("/healthz").status, 200);
}

TEST(ApiAccess, OtherMachinesAreNotServedWithoutAToken) {
    const Sandbox sandbox;
    Service service(sandbox, {"--host", "0.0.0.0"});
    EXPECT_FALSE(service.valid());
    EXPECT_EQ(service.exit_code(), 2);
    EXPECT_NE(service.complaint().find("--token-file"), std::string::npos) << service.complaint();
    EXPECT_NE(service.complaint().find("nginx"), std::string::npos) << service.complaint();
}

TEST(ApiAccess, PortInUseIsSaid) {
    const Sandbox one;
    const Sandbox two;
    Service first(one);
    Service second(two, {"--port", std::to_string(first.port())});
    EXPECT_FALSE(second.valid());
    EXPECT_EQ(second.exit_code(), 74);
    EXPECT_NE(second.complaint().find("port"), std::string::npos);
}

}  // namespace
}  // namespace breach::testing::api_test
