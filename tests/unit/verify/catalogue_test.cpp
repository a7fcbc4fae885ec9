// The catalogue refuses uncheckable entries; a failing program is a row; numbers are found in the
// outputs of programs.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "core/fault/fault.hpp"
#include "services/verify/page.hpp"
#include "tests/folder.hpp"

namespace breach::verify::catalogue_test {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

json quantity(double right) {
    return {{"what", "answer"},
            {"at", "/answer"},
            {"right", right},
            {"relative", 0.01},
            {"because", "three digits"}};
}

json topic(const json& quantities) {
    const json one{{"id", "one"},
                   {"question", "q"},
                   {"source", "s"},
                   {"kind", "closed form"},
                   {"commands", json::array({json::array({"program", "{output}"})})},
                   {"quantities", quantities}};
    return {{"title", "T"}, {"cases", json::array({one})}};
}

/// A catalogue of one file, and a program that writes these outputs.
class Bench {
  public:
    explicit Bench(const json& file,
                   const std::string& script = "echo '{\"answer\": 1.005}' > \"$1/result.json\"") {
        fs::create_directories(folder_.path() / "catalogue");
        std::ofstream(folder_.path() / "catalogue/topic.json") << file.dump();
        std::ofstream(folder_.path() / "program") << "#!/bin/sh\n" << script << "\n";
        fs::permissions(folder_.path() / "program", fs::perms::owner_all);
    }
    std::vector<Topic> catalogue() const { return catalogue_in(folder_.path() / "catalogue"); }
    std::vector<Outcome> outcomes(const std::vector<Topic>& topics, bool quick = false) const {
        return compare(topics,
                       {.programs = folder_.path(),
                        .output = folder_.path() / "out",
                        .quick = quick,
                        .slots = 2},
                       [](const Outcome&, std::size_t) {});
    }

  private:
    test::Folder folder_;
};

std::string pointer_of_refusal(const json& file) {
    try {
        Bench(file).catalogue();
    } catch (const fault::BadInput& refusal) {
        return refusal.faults().front().pointer;
    }
    return "accepted";
}

TEST(Catalogue, RefusesAQuantityWithoutToleranceReasonOrRightValue) {
    for (const char* key : {"right", "relative", "because", "what", "at"}) {
        json without = quantity(1.0);
        without.erase(key);
        const std::string named = std::string(key) == "relative" ? "absolute" : key;
        EXPECT_EQ(pointer_of_refusal(topic(json::array({without}))),
                  "/cases/0/quantities/0/" + named);
    }
}

TEST(Catalogue, RefusesACaseWithoutSourceAndAWordItDoesNotKnow) {
    json file = topic(json::array({quantity(1.0)}));
    file["cases"][0].erase("source");
    EXPECT_EQ(pointer_of_refusal(file), "/cases/0/source");
    file = topic(json::array({quantity(1.0)}));
    file["cases"][0]["tolerence"] = 1;
    EXPECT_EQ(pointer_of_refusal(file), "/cases/0/tolerence");
    file = topic(json::array({quantity(1.0)}));
    file["cases"].push_back(file["cases"][0]);
    EXPECT_EQ(pointer_of_refusal(file), "/cases") << "two of one id";
}

TEST(Comparison, IsWithinOrBeyondItsTolerance) {
    const Bench bench(topic(json::array({quantity(1.0), quantity(1.02)})));
    const auto topics = bench.catalogue();
    const auto outcomes = bench.outcomes(topics);
    ASSERT_EQ(outcomes.size(), 1U);
    EXPECT_TRUE(outcomes[0].found[0].passed());
    EXPECT_NEAR(outcomes[0].found[0].used(), 0.5, 1e-12);
    EXPECT_FALSE(outcomes[0].found[1].passed());
    const Sum sum = sum_of(outcomes);
    EXPECT_EQ(sum.comparisons, 2U);
    EXPECT_EQ(sum.passed, 1U);
}

TEST(Comparison, AProgramThatFailsIsARow) {
    const Bench bench(topic(json::array({quantity(1.0)})), "exit 70");
    const auto topics = bench.catalogue();
    const auto outcomes = bench.outcomes(topics);
    EXPECT_FALSE(outcomes[0].found[0].passed());
    EXPECT_NE(outcomes[0].found[0].problem.find("exit code 70"), std::string::npos);
    EXPECT_NE(as_markdown(topics, outcomes, {}).find("**failed**"), std::string::npos);
}

TEST(Comparison, ARefusalIsRightByItsExitCodeAndItsWords) {
    json file = topic(json::array());
    file["cases"][0].erase("quantities");
    file["cases"][0]["refused"] = {{"exit", 65}, {"says", {"/mpm/duration"}}};
    const auto passes = [&](const std::string& script) {
        const Bench bench(file, script);
        const auto topics = bench.catalogue();
        return bench.outcomes(topics)[0].found[0].passed();
    };
    EXPECT_TRUE(passes("echo /mpm/duration: is 0 >&2; exit 65"));
    EXPECT_FALSE(passes("echo /mpm/cell_size: is 0 >&2; exit 65"));
    EXPECT_FALSE(passes("echo /mpm/duration: is 0 >&2; exit 70"));
    EXPECT_FALSE(passes("echo /mpm/duration: is 0 >&2; exit 0"));

    file["cases"][0]["refused"]["says"] = json::array();
    EXPECT_EQ(pointer_of_refusal(file), "/cases/0/refused/says");
    file["cases"][0]["refused"]["says"] = {"x"};
    file["cases"][0]["quantities"] = json::array({quantity(1.0)});
    EXPECT_EQ(pointer_of_refusal(file), "/cases/0/refused");
}

TEST(Comparison, OnlyTheCasesOwnProgramRunsWhereTheFileHasCommands) {
    json file = topic(json::array({quantity(1.0)}));
    file["commands"] = {{"program", "{output}", "of the file"}};
    file["cases"][0].erase("commands");
    EXPECT_EQ(Bench(file).catalogue()[0].cases[0].commands[0].back(), "of the file");
    file["cases"][0]["set"] = {"/a=1"};
    EXPECT_EQ(Bench(file).catalogue()[0].cases[0].commands[0].back(), "/a=1");
    file["cases"][0]["program"] = "own";
    EXPECT_EQ(Bench(file).catalogue()[0].cases[0].commands[0].front(), "own");
}

TEST(Comparison, ANumberThatIsNotThereFails) {
    json other = quantity(1.0);
    other["at"] = "/elsewhere";
    const Bench bench(topic(json::array({other})));
    const auto topics = bench.catalogue();
    EXPECT_EQ(bench.outcomes(topics)[0].found[0].problem, "no number at /elsewhere in result.json");
}

TEST(Comparison, ReadsLinesBetweenTwoTimesAndColumnsOfCsv) {
    json line = quantity(1.5), column = quantity(30.0);
    line["file"] = "telemetry.jsonl", line["where"] = {{"/time", 0.5}};
    column["file"] = "table.csv", column["at"] = "depth", column["where"] = {{"x", 3}};
    const Bench bench(
        topic(json::array({line, column})),
        "echo '{\"time\":0,\"answer\":1}\n{\"time\":1,\"answer\":2}' > \"$1/telemetry.jsonl\"; "
        "printf '# remark\\nx,depth\\n2,20\\n3,30\\n' > \"$1/table.csv\"");
    const auto topics = bench.catalogue();
    const auto outcomes = bench.outcomes(topics);
    EXPECT_DOUBLE_EQ(outcomes[0].found[0].value.value(), 1.5);
    EXPECT_DOUBLE_EQ(outcomes[0].found[1].value.value(), 30.0);
}

TEST(Comparison, AnOrderOfConvergenceIsOverTheLevelsOfACase) {
    // The result is 3 + size^2, with the size from --set SIZE.
    json order = quantity(2.0);
    order["limit"] = 3.0;
    json file = topic(json::array({order}));
    const auto level = [](double size, const char* set) {
        return json{{"size", size}, {"set", {set}}};
    };
    file["cases"][0]["levels"] = {level(4, "4"), level(2, "2"), level(1, "1")};
    const Bench bench(file, "echo \"{\\\"answer\\\": $((3 + $3 * $3))}\" > \"$1/result.json\"");
    const auto topics = bench.catalogue();
    const auto outcomes = bench.outcomes(topics);
    EXPECT_EQ(outcomes[0].found[0].problem, "");
    EXPECT_NEAR(outcomes[0].found[0].value.value_or(0.0), 2.0, 1e-12);

    json two = file;
    two["cases"][0]["levels"].erase(2);
    EXPECT_EQ(pointer_of_refusal(two), "/cases/0/levels");
    json no_limit = file;
    no_limit["cases"][0]["quantities"][0].erase("limit");
    EXPECT_EQ(pointer_of_refusal(no_limit), "/cases/0/quantities/0/limit");
}

TEST(Comparison, LeavesSlowCasesOutOfQuick) {
    json file = topic(json::array({quantity(1.0)}));
    file["cases"][0]["slow"] = true;
    const Bench bench(file);
    const auto topics = bench.catalogue();
    EXPECT_TRUE(bench.outcomes(topics, true).empty());
    EXPECT_EQ(bench.outcomes(topics, false).size(), 1U);
}

}  // namespace
}  // namespace breach::verify::catalogue_test
