#include "services/cli/crate.hpp"

#include <gtest/gtest.h>

#include <set>

namespace breach::cli {

using nlohmann::json;

namespace {

const json run{{"id", "R"},
               {"name", "sweep"},
               {"title", "t"},
               {"created", "2026-11-21T02:38:53Z"},
               {"finished", nullptr}};

json task(const char* id, const char* phase, const char* state) {
    return {{"id", id},
            {"phase", phase},
            {"state", state},
            {"transfer_time", nullptr},
            {"started", "2026-11-21T02:38:54Z"},
            {"finished", nullptr},
            {"fault", nullptr},
            {"attempts", json::array({{{"number", 1}}})}};
}

json entity(const json& document, const std::string& id) {
    for (const json& each : document["@graph"])
        if (each["@id"] == id) return each;
    return nullptr;
}

}  // namespace

TEST(Crate, NamesEveryFileAndEveryReferenceIsInIt) {
    Crate crate;
    crate.add_file({.path = "study.json", .description = "the study", .bytes = 3, .sha256 = "aa"});
    crate.add_file({.path = "tasks/fem/a b.vtkhdf", .description = "", .bytes = 5, .sha256 = "bb"});
    crate.add_action(task("R-0", "fem_solver", "succeeded"), {{"version", "0.1.0"}},
                     {"tasks/fem/a b.vtkhdf"});
    const json document = crate.metadata(run);
    std::set<std::string> known{"https://w3id.org/ro/crate/1.1"};
    for (const json& each : document["@graph"])
        EXPECT_TRUE(known.insert(each["@id"]).second) << each;
    for (const json& each : document["@graph"]) {
        for (const auto& [key, value] : each.items()) {
            for (const json& one : value.is_array() ? value : json::array({value}))
                EXPECT_TRUE(!one.is_object() || known.contains(one["@id"])) << each << key;
        }
    }
    EXPECT_EQ(entity(document, "./")["hasPart"].size(), 2);
    EXPECT_EQ(entity(document, "tasks/fem/a%20b.vtkhdf")["contentSize"], "5");
}

TEST(Crate, FindsAnActionsInputsByTheirHash) {
    Crate crate;
    crate.add_file({.path = "study.json", .description = "", .bytes = 3, .sha256 = "aa"});
    crate.add_file({.path = "snapshot.vtkhdf", .description = "", .bytes = 5, .sha256 = "bb"});
    const json provenance{
        {"version", "0.1.0"},
        {"inputs", {{{"path", "/x"}, {"sha256", "bb"}}, {{"path", "/y"}, {"sha256", "zz"}}}}};
    crate.add_action(task("R-1", "transfer_tool", "succeeded"), provenance, {});
    const json action = entity(crate.metadata(run), "#R-1");
    EXPECT_EQ(action["object"],
              json::parse(R"([{"@id": "study.json"}, {"@id": "snapshot.vtkhdf"}])"));
    EXPECT_EQ(action["instrument"]["@id"], "#transfer_tool-0.1.0");
    EXPECT_EQ(action["actionStatus"], "http://schema.org/CompletedActionStatus");
}

TEST(Crate, SaysThatATaskFailedAndLeavesOutWhatNeverRan) {
    Crate crate;
    json failed = task("R-1", "mpm_solver", "failed");
    failed["fault"] = {{"exit_code", 70}, {"summary", "entangled"}};
    crate.add_action(failed, nullptr, {});
    json skipped = task("R-2", "mpm_solver", "skipped");
    skipped["attempts"] = json::array();
    crate.add_action(skipped, nullptr, {});
    const json document = crate.metadata(run);
    EXPECT_EQ(entity(document, "#R-1")["error"], "entangled");
    EXPECT_EQ(entity(document, "#R-1")["actionStatus"], "http://schema.org/FailedActionStatus");
    EXPECT_TRUE(entity(document, "#R-2").is_null());
}

}  // namespace breach::cli
