// Stored scenes: by content and by name, and runs that use them.
#include <gtest/gtest.h>

#include "tests/faults/service_under_test.hpp"

namespace breach::testing::stored_scene_test {
namespace {

using nlohmann::json;

json scene_with(double cfl) {
    json scene = study("", {0.5}).at("scene");
    scene["mpm"]["cfl"] = cfl;
    return scene;
}

json study_of(const std::string& reference) {
    json wanted = study("", {0.5});
    wanted["scene"] = reference;
    return wanted;
}

TEST(StoredScenes, AreKnownByTheirContentAndByNamesWithVersions) {
    const Sandbox sandbox;
    Service service(sandbox);
    const Answer first = service.post("/v1/scenes?name=dam", scene_with(0.3).dump());
    ASSERT_EQ(first.status, 201) << first.text;
    const std::string sha256 = first.body.at("sha256");
    EXPECT_EQ(first.headers.find("Location")->second, "/v1/scenes/" + sha256);
    // The same content in another form: the completed scene decides.
    EXPECT_EQ(service.post("/v1/scenes?name=dam", scene_with(0.3).dump(3)).status, 200);
    EXPECT_EQ(service.post("/v1/scenes", scene_with(0.3).dump()).status, 200);
    const Answer second = service.post("/v1/scenes?name=dam", scene_with(0.4).dump());
    ASSERT_EQ(second.status, 201);

    const json newest = service.get("/v1/scenes/dam").body;
    EXPECT_EQ(newest.at("sha256"), second.body.at("sha256"));
    EXPECT_EQ(newest.at("scene").at("mpm").at("cfl"), 0.4);
    EXPECT_EQ(newest.at("version"), 2);
    ASSERT_EQ(newest.at("versions").size(), 2u);
    EXPECT_EQ(service.get("/v1/scenes/dam@1").body.at("sha256"), sha256);
    EXPECT_EQ(service.get("/v1/scenes/" + sha256).body.at("scene").at("mpm").at("cfl"), 0.3);
    for (const char* none : {"dam@3", "dam@0", "dam@", "dam@x", "other"})
        EXPECT_EQ(service.get(std::string("/v1/scenes/") + none).status, 404) << none;

    const json page = service.get("/v1/scenes?limit=1").body;
    ASSERT_EQ(page.at("scenes").size(), 1u);
    EXPECT_EQ(page.at("scenes")[0].at("sha256"), second.body.at("sha256"));
    const json rest =
        service.get("/v1/scenes?limit=1&cursor=" + page.at("next").get<std::string>()).body;
    EXPECT_EQ(rest.at("scenes")[0].at("sha256"), sha256);
    EXPECT_TRUE(rest.at("next").is_null());
    EXPECT_EQ(service.get("/v1/scenes?search=da").body.at("scenes").size(), 2u);
    EXPECT_EQ(service.get("/v1/scenes?name=da").body.at("scenes").size(), 0u);
}

TEST(StoredScenes, AreRefusedAsAStudysSceneWouldBe) {
    const Sandbox sandbox;
    Service service(sandbox);
    json wrong = scene_with(0.3);
    wrong["mpm"]["cfl"] = -1;
    const Answer refused = service.post("/v1/scenes", wrong.dump());
    EXPECT_EQ(refused.status, 422);
    EXPECT_EQ(refused.body.at("faults")[0].at("pointer"), "/mpm/cfl");
    EXPECT_EQ(service.post("/v1/scenes", study("", {0.5}).dump()).status, 422);
    for (const std::string name : {"Dam", "a/b", "", "-a", "a@1"})
        EXPECT_EQ(service.post("/v1/scenes?name=" + name, scene_with(0.3).dump()).status, 400)
            << name;
    EXPECT_EQ(
        service.post("/v1/scenes?name=" + std::string(64, 'a'), scene_with(0.3).dump()).status,
        400);
}

TEST(StoredScenes, AreWhatAStudyRefersToAndLaterVersionsChangeNothing) {
    const Sandbox sandbox;
    Service service(sandbox);
    const std::string sha256 =
        service.post("/v1/scenes?name=dam", scene_with(0.3).dump()).body.at("sha256");
    const std::string run = service.submit(study_of("scene:dam"));
    service.post("/v1/scenes?name=dam", scene_with(0.4).dump());
    const json end = service.wait_for_end(run);
    EXPECT_EQ(end.at("state"), "succeeded") << end.at("message");
    EXPECT_EQ(end.at("study").at("scene").at("mpm").at("cfl"), 0.3);
    EXPECT_EQ(end.at("scene_from"), json({{"sha256", sha256}, {"name", "dam"}, {"version", 1}}));

    const std::string newest = service.submit(study_of("scene:dam"));
    const std::string old = service.submit(study_of("scene:dam@1"));
    const std::string exact = service.submit(study_of("scene:sha256/" + sha256));
    EXPECT_EQ(service.wait_for_end(newest).at("study").at("scene").at("mpm").at("cfl"), 0.4);
    EXPECT_EQ(service.wait_for_end(old).at("study").at("scene"), end.at("study").at("scene"));
    EXPECT_EQ(service.wait_for_end(exact).at("scene_from").at("name"), nullptr);
    EXPECT_EQ(service.post("/v1/cost", study_of("scene:dam").dump()).status, 200);

    for (const char* none : {"scene:slope", "scene:dam@9", "scene:sha256/12"}) {
        const Answer answer = service.post("/v1/runs", study_of(none).dump());
        EXPECT_EQ(answer.status, 422) << none;
        EXPECT_EQ(answer.body.at("faults")[0].at("pointer"), "/scene");
    }
    const std::string own = service.submit(study("", {0.5}));
    EXPECT_TRUE(service.wait_for_end(own).at("scene_from").is_null());
}

TEST(StoredScenes, AreRemovedWhenNothingNeedsThem) {
    const Sandbox sandbox;
    Service service(sandbox);
    const std::string sha256 =
        service.post("/v1/scenes?name=dam", scene_with(0.3).dump()).body.at("sha256");
    const std::string run = service.submit(study_of("scene:dam"));
    service.wait_for_end(run);
    EXPECT_EQ(service.ask("DELETE", "/v1/scenes/dam").status, 409);
    EXPECT_EQ(service.ask("DELETE", "/v1/scenes/" + sha256).status, 409);
    EXPECT_EQ(service.ask("DELETE", "/v1/runs/" + run).status, 202);
    EXPECT_EQ(service.ask("DELETE", "/v1/scenes/" + sha256).status, 409)
        << "its name stands for it";
    EXPECT_EQ(service.ask("DELETE", "/v1/scenes/dam").status, 202);
    EXPECT_EQ(service.get("/v1/scenes/" + sha256).status, 404);
    EXPECT_EQ(service.ask("DELETE", "/v1/scenes/dam").status, 404);
}

TEST(StoredScenes, OutliveAKill) {
    const Sandbox sandbox;
    std::string sha256;
    {
        Service service(sandbox);
        sha256 = service.post("/v1/scenes?name=dam", scene_with(0.3).dump()).body.at("sha256");
        service.kill_at_once();
    }
    Service service(sandbox);
    EXPECT_EQ(service.get("/v1/scenes/dam").body.at("sha256"), sha256);
}

}  // namespace
}  // namespace breach::testing::stored_scene_test
