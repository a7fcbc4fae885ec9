// kill -9 at each failpoint, then a restart: no acknowledged work is lost, nothing succeeds twice,
// and the event log is consistent.
#include "services/orchestrator/files/failpoint.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/faults/invariants.hpp"

namespace breach::testing {
namespace {

using nlohmann::json;

/// Failpoints that a plain study on the local pool reaches.
std::vector<std::string> places() {
    std::vector<std::string> found;
    for (const std::string_view each : orchestrator::failpoint_names) {
        const bool elsewhere = each.starts_with("firing") || each.starts_with("sbatch") ||
                               each.starts_with("reuse") || each.starts_with("removal") ||
                               each.starts_with("upload");
        if (!elsewhere) found.emplace_back(each);
    }
    return found;
}

class KilledAt : public ::testing::TestWithParam<std::string> {};

TEST_P(KilledAt, NothingIsLostAndNothingRunsTwice) {
    const Sandbox sandbox;
    const std::string wanted = study("", {0.25, 0.5}).dump();
    const std::multimap<std::string, std::string> key{{"Idempotency-Key", "the-one"}};
    const auto token = sandbox.root() / "token";
    std::ofstream(token) << "\n";
    std::string run;
    {
        Service first(sandbox, {}, {"BREACHLINE_FAILPOINT=" + GetParam() + ":1:" + token.string()});
        ASSERT_TRUE(first.valid()) << first.complaint();
        const Answer answer = first.post("/v1/runs", wanted, "application/json", key);
        if (answer.status == 202) run = answer.body.at("id");
        ASSERT_TRUE(eventually([&] { return !std::filesystem::exists(token); })) << "not reached";
        const bool of_supervisor = GetParam().starts_with("supervisor");
        if (of_supervisor) {
            first.wait_for_end(run);
        } else {
            EXPECT_EQ(first.get("/healthz").status, 0) << "it is dead";
            first.kill_at_once();
        }
    }
    {
        Service second(sandbox);
        ASSERT_TRUE(second.valid()) << second.complaint();
        const Answer again = second.post("/v1/runs", wanted, "application/json", key);
        ASSERT_EQ(again.status, 202) << again.text;
        if (!run.empty()) {
            EXPECT_EQ(again.body.at("id"), run) << "acknowledged and lost";
        }
        run = again.body.at("id");
        const json end = second.wait_for_end(run);
        EXPECT_EQ(end.at("state"), "succeeded") << end.at("message");
        const json rows = second.table(run);
        ASSERT_EQ(rows.size(), 2u);
        for (const json& row : rows) {
            const double time = row.at("transfer_time");
            EXPECT_EQ(row.at("runout"), 10 + time * time);
        }
        EXPECT_EQ(second.get("/v1/runs").body.at("runs").size(), 1u);
    }
    expect_sound_history(sandbox);
}

INSTANTIATE_TEST_SUITE_P(Place, KilledAt, ::testing::ValuesIn(places()),
                         [](const auto& each) { return each.param; });

/// Failpoints of the service's own threads, without the store's disk writes.
std::vector<std::string> places_of_threads() {
    std::vector<std::string> found;
    for (const std::string& each : places())
        if (!each.starts_with("store") && !each.starts_with("supervisor")) found.push_back(each);
    return found;
}

class TroubledAt : public ::testing::TestWithParam<std::string> {};

TEST_P(TroubledAt, NoTaskIsLeftBehind) {
    const Sandbox sandbox;
    const auto token = sandbox.root() / "token";
    std::ofstream(token) << "\n";
    {
        Service service(sandbox, {}, {"BREACHLINE_TROUBLE=" + GetParam() + ":1:" + token.string()});
        const std::string run = service.submit(study("", {0.25, 0.5}));
        const json end = service.wait_for_end(run);
        EXPECT_EQ(end.at("state"), "succeeded") << end.dump();
        EXPECT_FALSE(std::filesystem::exists(token)) << "not reached";
        for (const json& row : service.table(run)) {
            const double time = row.at("transfer_time");
            EXPECT_EQ(row.at("runout"), 10 + time * time);
        }
    }
    expect_sound_history(sandbox);
}

INSTANTIATE_TEST_SUITE_P(Place, TroubledAt, ::testing::ValuesIn(places_of_threads()),
                         [](const auto& each) { return each.param; });

}  // namespace
}  // namespace breach::testing
