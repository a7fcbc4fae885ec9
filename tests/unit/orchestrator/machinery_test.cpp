// What the service reports about itself: workers and transfers.
#include <gtest/gtest.h>

#include <set>

#include "tests/faults/service_under_test.hpp"

namespace breach::testing::machinery_test {
namespace {

using nlohmann::json;

TEST(Workers, AreWhatRunsWithItsProcess) {
    const Sandbox sandbox;
    Service service(sandbox);
    EXPECT_TRUE(service.get("/v1/workers").body.at("workers").empty());
    json wanted = study("fem_steps=500", {2.7});  // its FEM is still running
    wanted["resources"] = {{"fem_solver", {{"cores", 1}, {"memory_MB", 700}}}};
    const std::string run = service.submit(wanted);
    json workers;
    ASSERT_TRUE(eventually([&] {  // its supervisor reports usage every two seconds
        workers = service.get("/v1/workers").body;
        for (const json& each : workers.at("workers"))
            if (each.at("phase") == "fem_solver" && each.at("pid").is_number()) return true;
        return false;
    }));
    EXPECT_EQ(workers.at("executor"), "local");
    EXPECT_TRUE(workers.at("slurm").is_null());
    EXPECT_GE(workers.at("slots_used"), 1);
    EXPECT_GE(workers.at("queue").at("blocked"),
              1);  // the MPM, and the transfer until its snapshot
    for (const json& each : workers.at("workers")) {
        if (each.at("phase") != "fem_solver") continue;
        EXPECT_EQ(each.at("run"), run);
        EXPECT_EQ(each.at("memory_MB"), 700);
        const auto alive = phases_alive(sandbox, "fem_solver");
        ASSERT_EQ(alive.size(), 1u);
        EXPECT_EQ(each.at("pid"), alive[0]);
        EXPECT_FALSE(each.at("host").get<std::string>().empty());
        EXPECT_GE(each.at("cpu_seconds"), 0.0);
    }
    service.post("/v1/runs/" + run + "/cancel", "");
    service.wait_for_end(run);
    EXPECT_TRUE(service.get("/v1/workers").body.at("workers").empty());
}

TEST(Transfers, SayWhyTheyWereMadeAndWhatCameOfThem) {
    const Sandbox sandbox;
    Service service(sandbox);
    const std::string run = service.submit(study("", {0.25, 0.5}));
    service.wait_for_end(run);
    const std::string again = service.submit(study("", {0.25, 0.5}));
    service.wait_for_end(again);
    const json own = service.get("/v1/runs/" + run + "/transfers").body.at("transfers");
    ASSERT_EQ(own.size(), 2u);
    const json rows = service.table(run);
    for (const json& each : own) {
        EXPECT_EQ(each.at("why"), "at_time");
        EXPECT_TRUE(each.at("trigger").is_null());
        EXPECT_GE(each.at("start_ms"), 0);
        ASSERT_EQ(each.at("runouts").size(), 1u);
        const json& row = rows[each.at("transfer_time") == 0.25 ? 0 : 1];
        EXPECT_EQ(each.at("runouts")[0].at("runout"), row.at("runout"));
    }
    const json page = service.get("/v1/transfers?limit=3").body;
    ASSERT_EQ(page.at("transfers").size(), 3u);
    EXPECT_EQ(page.at("transfers")[0].at("run"), again);
    EXPECT_TRUE(page.at("transfers")[0].at("same_as").is_string());
    EXPECT_TRUE(page.at("transfers")[0].at("start_ms").is_null()) << "nothing was started";
    const std::string next = page.at("next");
    EXPECT_EQ(service.get("/v1/transfers?limit=3&cursor=" + next).body.at("transfers").size(), 1u);
    EXPECT_EQ(service.get("/v1/transfers?why=chance").status, 400);
    EXPECT_EQ(service.get("/v1/transfers?state=odd").status, 400);
    EXPECT_EQ(service.get("/v1/runs/none/transfers").status, 404);
}

}  // namespace
}  // namespace breach::testing::machinery_test
