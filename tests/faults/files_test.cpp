// Uploaded files: identified by content, refused if no phase reads them, kept as long as a run
// names them; complete or absent whenever the service is killed.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <thread>

#include "tests/faults/invariants.hpp"

namespace breach::testing {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Two columns: time [s], acceleration [g].
std::string motion(double peak = 0.2) {
    std::ostringstream text;
    for (int i = 0; i < 200; ++i) text << 0.01 * i << " " << peak * ((i % 20) - 9.5) / 10 << "\n";
    return text.str();
}

Answer send(Service& service, const std::string& name, const std::string& content) {
    return service.post("/v1/files?name=" + name, content, "application/octet-stream");
}

std::string hash_of(const Answer& answer) { return answer.body.value("sha256", ""); }

std::size_t files_in(const fs::path& folder) {
    std::size_t count = 0;
    for ([[maybe_unused]] const auto& each : fs::directory_iterator(folder)) ++count;
    return count;
}

/// The tests' study with the motion in this entry.
json shaken(const std::string& file) {
    json wanted = study("", {0.25});
    json& fem = wanted["scene"]["fem"];
    fem["base"] = {{"density", 2000}, {"V_s", 300}};
    fem["motion"] = {{"file", file}};
    return wanted;
}

TEST(Files, AreKnownByTheirContentAndComeBackAsTheyWereSent) {
    const Sandbox sandbox;
    Service service(sandbox);
    const Answer first = send(service, "record.txt", motion());
    ASSERT_EQ(first.status, 201) << first.text;
    EXPECT_EQ(first.body.at("kind"), "motion");
    EXPECT_EQ(first.body.at("reference"), "file:sha256/" + hash_of(first) + ".txt");
    EXPECT_EQ(send(service, "other_name.txt", motion()).status, 200) << "known";
    const std::string path = "/v1/files/" + hash_of(first);
    EXPECT_EQ(service.get(path).text, motion());
    EXPECT_EQ(service.ask("HEAD", path).status, 200);
    EXPECT_EQ(service.ask("HEAD", "/v1/files/" + std::string(64, '0')).status, 404);
    EXPECT_EQ(service.get("/v1/files").body.at("files").size(), 1u);
    EXPECT_EQ(files_in(sandbox.data() / "scratch"), 0u);
}

TEST(Files, AreRefusedWhenNoPhaseReadsThem) {
    const Sandbox sandbox;
    Service service(sandbox, {"--largest-file", "1"});
    const Answer words = send(service, "poem.txt", "shall I compare thee\n");
    EXPECT_EQ(words.status, 422);
    EXPECT_EQ(words.body.at("faults")[0].at("pointer"), "line 1");
    EXPECT_NE(words.body.at("faults")[0].at("remedy").get<std::string>().find(".msh"),
              std::string::npos);
    EXPECT_EQ(send(service, "mesh.msh", "$MeshFormat\n3 0 8\n").status, 422);
    EXPECT_EQ(send(service, "mesh.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n").status, 201);
    EXPECT_EQ(send(service, "empty.csv", "").status, 422);
    EXPECT_EQ(send(service, "", motion()).status, 400);
    EXPECT_EQ(send(service, "a%0Ab.csv", motion()).status, 400);
    EXPECT_EQ(send(service, "large.txt", std::string(3 << 20, ' ')).status, 413);
    EXPECT_EQ(service.post("/v1/files?name=a.csv", motion()).status, 415) << "as JSON";
    const std::string other = "/v1/files?name=a.txt&sha256=" + std::string(64, '0');
    EXPECT_EQ(service.post(other, motion(), "application/octet-stream").body.at("type"),
              "/problems/hash-mismatch");
    EXPECT_EQ(service.get("/v1/files").body.at("files").size(), 1u);
    EXPECT_EQ(files_in(sandbox.data() / "scratch"), 0u);
    EXPECT_EQ(files_in(sandbox.data() / "files"), 1u);
    EXPECT_EQ(service.get("/healthz").status, 200);
}

TEST(Files, PathAndReferenceToTheSameBytesAreTheSameQuestion) {
    const Sandbox sandbox;
    Service service(sandbox);
    const auto path = sandbox.root() / "record.txt";
    std::ofstream(path) << motion();
    const json first = service.wait_for_end(service.submit(shaken(path)));
    EXPECT_EQ(first.at("state"), "succeeded") << first.at("message");
    const Answer answer = send(service, "record.txt", motion());
    const json second = service.wait_for_end(service.submit(shaken(answer.body.at("reference"))));
    EXPECT_EQ(task_labelled(second, "fem").at("state"), "cached");
    EXPECT_EQ(second.at("files").size(), 1u);
    EXPECT_EQ(second.at("study").at("scene").at("fem").at("motion").at("file"),
              answer.body.at("reference"));
    // Another motion is another input.
    const Answer other = send(service, "stronger.txt", motion(0.4));
    const json third = service.wait_for_end(service.submit(shaken(other.body.at("reference"))));
    EXPECT_EQ(task_labelled(third, "fem").at("state"), "succeeded");
    const auto link =
        sandbox.data() / "runs" / third.at("id") / "files" / (hash_of(other) + ".txt");
    EXPECT_TRUE(fs::exists(link)) << "beside the scene";
}

TEST(Files, AreKeptWhileARunNamesThem) {
    const Sandbox sandbox;
    Service service(sandbox);
    const Answer answer = send(service, "record.txt", motion());
    const std::string path = "/v1/files/" + hash_of(answer);
    json by_override = shaken("/nowhere.txt");
    by_override["overrides"] = {"/fem/motion/file=" +
                                answer.body.at("reference").get<std::string>()};
    const std::string run = service.submit(by_override);
    EXPECT_EQ(service.wait_for_end(run).at("state"), "succeeded");
    EXPECT_EQ(service.get("/v1/files").body.at("files")[0].at("runs"), json::array({run}));
    EXPECT_EQ(service.ask("DELETE", path).status, 409);
    EXPECT_EQ(service.ask("DELETE", "/v1/runs/" + run).status, 202);
    EXPECT_EQ(service.ask("DELETE", path).status, 202);
    EXPECT_EQ(service.ask("HEAD", path).status, 404);
    EXPECT_EQ(files_in(sandbox.data() / "files"), 0u);
    const Answer refused = service.post("/v1/runs", by_override.dump());
    EXPECT_EQ(refused.status, 422) << "it is gone";
    EXPECT_NE(refused.text.find("does not exist"), std::string::npos) << refused.text;
    EXPECT_NE(refused.text.find("POST /v1/files"), std::string::npos) << refused.text;
}

class KilledWhileSending : public ::testing::TestWithParam<std::string> {};

TEST_P(KilledWhileSending, TheFileIsWholeOrSentAgain) {
    const Sandbox sandbox;
    const auto token = sandbox.root() / "token";
    std::ofstream(token) << "\n";
    {
        Service service(sandbox, {},
                        {"BREACHLINE_FAILPOINT=" + GetParam() + ":1:" + token.string()});
        EXPECT_EQ(send(service, "record.txt", motion()).status, 0);
        EXPECT_FALSE(fs::exists(token)) << "not reached";
        service.kill_at_once();
    }
    Service service(sandbox);
    ASSERT_TRUE(service.valid()) << service.complaint();
    EXPECT_EQ(files_in(sandbox.data() / "scratch"), 0u) << "what was on its way";
    const json before = service.get("/v1/files").body.at("files");
    const bool known = !before.empty();
    EXPECT_EQ(known, GetParam() == "store_after_commit");
    const Answer again = send(service, "record.txt", motion());
    EXPECT_EQ(again.status, known ? 200 : 201);
    EXPECT_EQ(service.get("/v1/files/" + hash_of(again)).text, motion());
    EXPECT_EQ(service.wait_for_end(service.submit(shaken(again.body.at("reference")))).at("state"),
              "succeeded");
    EXPECT_EQ(files_in(sandbox.data() / "files"), 1u);
}

INSTANTIATE_TEST_SUITE_P(Place, KilledWhileSending,
                         ::testing::Values("upload_before", "upload_after", "store_before_commit",
                                           "store_after_commit"),
                         [](const auto& each) { return each.param; });

}  // namespace
}  // namespace breach::testing
