// An extended sweep keeps its results and equals a single submission.
#include <gtest/gtest.h>

#include "tests/faults/service_under_test.hpp"

namespace breach::testing::extension_test {
namespace {

using nlohmann::json;

std::map<std::string, std::size_t> attempts_by_label(const json& run) {
    std::map<std::string, std::size_t> found;
    for (const json& each : run.at("tasks")) found[each.at("label")] = each.at("attempts").size();
    return found;
}

TEST(Extension, AddsTimesAndKeepsWhatIsThere) {
    const Sandbox sandbox;
    Service service(sandbox);
    json sent = study("", {0.5, 1.0});
    sent["overrides"] = {"/mpm/cfl=0.3", "/mpm/cfl=0.31"};
    const std::string run = service.submit(sent);
    const json warnings = service.wait_for_end(run).at("warnings");
    EXPECT_FALSE(warnings.empty());
    const json before = service.table(run);
    const auto answer =
        service.post("/v1/sweeps/" + run + "/extend", R"({"transfer_times": [0.75, 1.0]})");
    ASSERT_EQ(answer.status, 202) << answer.text;
    EXPECT_EQ(answer.body.at("added"), json::array({0.75}));
    EXPECT_EQ(answer.body.at("state"), "running");
    const json end = service.wait_for_end(run);
    EXPECT_EQ(end.at("state"), "succeeded") << end.at("message");
    EXPECT_EQ(end.at("warnings"), warnings) << "each once";
    const json rows = service.table(run);
    ASSERT_EQ(rows.size(), 3u);
    EXPECT_EQ(rows[0], before[0]);
    EXPECT_EQ(rows[2], before[1]);
    EXPECT_EQ(rows[1].at("runout"), 10 + 0.75 * 0.75);
    const auto attempts = attempts_by_label(end);
    EXPECT_EQ(attempts.at("fem"), 1u);
    EXPECT_EQ(attempts.at("fem_2"), 1u);  // the first one took no snapshot at 0.75 s
    EXPECT_EQ(attempts.at("mpm_0.500000"), 1u);
    EXPECT_EQ(end.at("study").at("transfer_times"), json::array({0.5, 0.75, 1.0}));

    // A single submission reuses what was computed for the extension.
    const std::string whole = service.submit(study("", {0.5, 0.75, 1.0}));
    EXPECT_EQ(service.wait_for_end(whole).at("state"), "succeeded");
    const json body = service.get("/v1/runs/" + whole).body;
    for (const json& each : body.at("tasks")) {
        if (each.at("phase") == "fem_solver") {
            EXPECT_FALSE(each.at("same_as").is_null());
        }
    }
}

TEST(Extension, DoesNotApplyTheOverridesTwice) {
    const Sandbox sandbox;
    Service service(sandbox);
    const auto appending = [](const std::vector<double>& times) {
        json made = study("", times);
        made["overrides"] = {R"(/fem/surcharge/-={"from":0,"to":10,"pressure_kPa":5})"};
        return made;
    };
    const std::string run = service.submit(appending({0.5}));
    service.wait_for_end(run);
    service.post("/v1/sweeps/" + run + "/extend", R"({"transfer_times": [0.75]})");
    const json end = service.wait_for_end(run);
    EXPECT_EQ(end.at("state"), "succeeded") << end.at("message");
    EXPECT_EQ(end.at("study").at("overrides"), appending({}).at("overrides"));

    const auto first_answer = [&](const json& study) {
        const std::string id = service.submit(study);
        service.wait_for_end(id);
        const json body = service.get("/v1/runs/" + id).body;
        return task_labelled(body, "fem").at("same_as");
    };
    EXPECT_EQ(first_answer(appending({0.5, 0.75})), task_labelled(end, "fem_2").at("id"));
    json doubled = appending({0.5, 0.75});
    doubled["overrides"].push_back(doubled["overrides"][0]);
    EXPECT_TRUE(first_answer(doubled).is_null()) << "nobody has computed this one";
}

TEST(Extension, NeedsNoFemForSnapshotsThatExist) {
    const Sandbox sandbox;
    Service service(sandbox);
    json wanted = study("", {0.5});
    wanted["scene"]["fem"]["snapshot_times"] = {0.25, 0.75};
    const std::string run = service.submit(wanted);
    service.wait_for_end(run);
    service.post("/v1/sweeps/" + run + "/extend", R"({"transfer_times": [0.25, 0.75]})");
    const json end = service.wait_for_end(run);
    EXPECT_EQ(end.at("state"), "succeeded") << end.at("message");
    EXPECT_EQ(service.table(run).size(), 3u);
    EXPECT_FALSE(attempts_by_label(end).contains("fem_2"));
}

TEST(Extension, IsCheckedLikeAStudy) {
    const Sandbox sandbox;
    Service service(sandbox);
    const std::string run = service.submit(study("", {0.5}));
    const std::string path = "/v1/sweeps/" + run + "/extend";
    EXPECT_EQ(service.post(path, R"({"transfer_times": [99]})").status, 422);
    EXPECT_EQ(service.post(path, R"({"transfer_times": "soon"})").status, 422);
    EXPECT_EQ(service.post(path, R"({"times": [1]})").status, 400);
    EXPECT_EQ(service.post("/v1/sweeps/nobody/extend", R"({"transfer_times": [1]})").status, 404);
    EXPECT_TRUE(service.post(path, R"({"transfer_times": [0.5]})").body.at("added").empty());
    service.post("/v1/runs/" + run + "/cancel", "");
    service.wait_for_end(run);
}

}  // namespace
}  // namespace breach::testing::extension_test
