// What the service reports about itself: workers, transfers, provenance of files.
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

/// Every name in a document's relations is described in it.
void expect_closed(const json& prov) {
    const std::map<std::string, const char*> kinds{
        {"prov:entity", "entity"},     {"prov:activity", "activity"},
        {"prov:agent", "agent"},       {"prov:generatedEntity", "entity"},
        {"prov:usedEntity", "entity"}, {"prov:informed", "activity"},
        {"prov:informant", "activity"}};
    for (const auto& [relation, all] : prov.items()) {
        if (relation == "prefix" || relation == "entity" || relation == "activity" ||
            relation == "agent")
            continue;
        for (const json& each : all)
            for (const auto& [role, id] : each.items())
                if (kinds.contains(role)) {
                    EXPECT_TRUE(prov.at(kinds.at(role)).contains(id.get<std::string>()))
                        << relation << ": " << id;
                }
    }
}

std::set<std::string> phases_in(const json& prov) {
    std::set<std::string> phases;
    for (const json& each : prov.at("activity")) phases.insert(each.at("breach:phase"));
    return phases;
}

const json& artifact_of(const json& run, const std::string& label, const std::string& name) {
    for (const json& each : task_labelled(run, label).at("artifacts"))
        if (each.at("name") == name) return each;
    throw std::runtime_error("no artifact " + name);
}

TEST(Provenance, LeadsFromARunoutToItsSceneAndStudy) {
    const Sandbox sandbox;
    Service service(sandbox);
    const std::string run = service.submit(study("", {0.5}));
    const json end = service.wait_for_end(run);
    const std::string runout = artifact_of(end, "mpm_0.500000", "result.json").at("sha256");
    const json prov = service.get("/v1/artifacts/" + runout + "/provenance").body;
    expect_closed(prov);
    EXPECT_EQ(phases_in(prov),
              (std::set<std::string>{"fem_solver", "transfer_tool", "mpm_solver"}));
    const std::string particles =
        artifact_of(end, "transfer_0.500000", "particles.vtkhdf").at("sha256");
    const std::string snapshot = artifact_of(end, "fem", "snapshot_0.500000.vtkhdf").at("sha256");
    for (const std::string& each : {runout, particles, snapshot})
        EXPECT_TRUE(prov.at("entity").contains("breach:file/" + each)) << each;
    EXPECT_TRUE(prov.at("entity").contains("breach:study/" + run));
    std::set<std::string> derived;
    for (const json& each : prov.at("wasDerivedFrom"))
        derived.insert(each.at("prov:generatedEntity").get<std::string>() + " " +
                       each.at("prov:usedEntity").get<std::string>());
    EXPECT_TRUE(derived.contains("breach:file/" + runout + " breach:file/" + particles));
    EXPECT_TRUE(derived.contains("breach:file/" + particles + " breach:file/" + snapshot));

    // A reused file names the task that computed it.
    const std::string again = service.submit(study("", {0.5}));
    const json cached = service.wait_for_end(again);
    EXPECT_EQ(task_labelled(cached, "fem").at("state"), "cached");
    const std::string same = artifact_of(cached, "fem", "snapshot_0.500000.vtkhdf").at("sha256");
    EXPECT_EQ(same, snapshot);
    const json of_same = service.get("/v1/artifacts/" + same + "/provenance").body;
    for (const json& each : of_same.at("activity")) EXPECT_EQ(each.at("breach:run"), run);
    EXPECT_EQ(service.get("/v1/artifacts/" + std::string(64, '0') + "/provenance").status, 404);

    // Its run was removed: only the one that reused it can be reported.
    EXPECT_EQ(service.ask("DELETE", "/v1/runs/" + run).status, 202);
    const json orphan = service.get("/v1/artifacts/" + same + "/provenance").body;
    expect_closed(orphan);
    for (const json& each : orphan.at("activity")) {
        EXPECT_EQ(each.at("breach:run"), again);
        EXPECT_NE(each.at("breach:note").get<std::string>().find("removed"), std::string::npos);
    }
}

}  // namespace
}  // namespace breach::testing::machinery_test
