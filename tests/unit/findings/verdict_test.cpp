// Each rule of services/findings, once.
#include "services/findings/verdict.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "services/findings/flags.hpp"
#include "services/findings/governing.hpp"

namespace breach::findings::verdict_test {

using fault::Severity;
using nlohmann::json;

Raised raised(const std::string& code, Severity severity, std::int64_t results, std::int64_t of) {
    return {{code, severity, "its message", "/mpm/cell_size"}, "mpm_solver", results, of, "mpm_1"};
}

TEST(Verdict, IsUsableWhereNothingIsAgainstIt) {
    const Verdict verdict = verdict_of({.state = "succeeded"});
    EXPECT_EQ(verdict.usable, Usable::yes);
    EXPECT_TRUE(verdict.reasons.empty());
    EXPECT_EQ(line_of(verdict), "");
}

TEST(Verdict, IsNoOfASectionThatDoesNotStandAsBuilt) {
    const Verdict verdict =
        verdict_of({.state = "succeeded", .unstable = Unstable{1, 1, 0.054, ""}});
    EXPECT_EQ(verdict.usable, Usable::no);
    ASSERT_EQ(verdict.reasons.size(), 1u);
    EXPECT_EQ(verdict.reasons[0].code, "does_not_stand");
    EXPECT_NE(verdict.reasons[0].text.find("0.054"), std::string::npos);
}

TEST(Verdict, IsQuestionableWhereSomeVariantsDoNotStand) {
    const Verdict verdict =
        verdict_of({.state = "succeeded", .unstable = Unstable{2, 5, 0.9, "wet"}});
    EXPECT_EQ(verdict.usable, Usable::questionable);
    EXPECT_NE(line_of(verdict).find("2 of 5 variants"), std::string::npos);
}

TEST(Verdict, IsNoOfImplausibleEntriesThoughTheyAreWarnings) {
    EXPECT_EQ(verdict_of({.state = "succeeded",
                          .raised = {raised("implausible", Severity::warning, 1, 1)}})
                  .usable,
              Usable::no);
    EXPECT_EQ(
        verdict_of({.state = "succeeded", .raised = {raised("far_crest", Severity::warning, 1, 1)}})
            .usable,
        Usable::with_remarks);
}

TEST(Verdict, HasEachWarningOfTheSubmissionThatNoResultRepeats) {
    const fault::Flag strong{"total_stress", Severity::warning, "too strong",
                             "/scene/materials/dam"};
    const fault::Flag coarse{"coarse_cells", Severity::warning, "variant \"wet\": its message",
                             "/scene/mpm/cell_size"};
    const fault::Flag other{"coarse_cells", Severity::warning, "another message", ""};
    const Verdict verdict =
        verdict_of({.state = "succeeded",
                    .submitted = {strong, coarse, other},
                    .raised = {raised("coarse_cells", Severity::warning, 1, 1)}});
    EXPECT_EQ(verdict.usable, Usable::with_remarks);
    ASSERT_EQ(verdict.reasons.size(), 3u);
    EXPECT_EQ(verdict.reasons[1].text, "Coarse cells, at submission: another message.");
    EXPECT_EQ(verdict.reasons[2].text,
              "Total stress, at submission (/scene/materials/dam): too strong.");
    EXPECT_EQ(verdict_of({.state = "queued", .submitted = {strong}}).reasons.size(), 2u);
}

TEST(Verdict, IsNoWhereNothingWasTransferred) {
    Facts facts{.state = "partial", .without_transfer = {{"", true, "window: not met"}}};
    EXPECT_EQ(verdict_of(facts).usable, Usable::no);
    facts.has_runout = true;
    facts.without_transfer.push_back({"a", false, "the FEM ended", "/transfer_times"});
    const Verdict verdict = verdict_of(facts);
    EXPECT_EQ(verdict.usable, Usable::questionable) << "another variant has one";
    ASSERT_EQ(verdict.reasons.size(), 2u);
    EXPECT_EQ(verdict.reasons[0].pointer, "/transfer_times");
    EXPECT_EQ(verdict.reasons[1].pointer, "/triggers");
}

TEST(Verdict, IsNoWhereAllTransfersCameBeforeLiquefactionHadEnded) {
    EXPECT_EQ(verdict_of({.state = "succeeded", .early = Early{2, 2, 1.0, 3.9}}).usable,
              Usable::no);
    EXPECT_EQ(verdict_of({.state = "succeeded", .early = Early{2, 9, 1.0, 3.9}}).usable,
              Usable::questionable);
}

TEST(Verdict, GivesTheWorstReasonFirst) {
    const Verdict verdict =
        verdict_of({.state = "questionable",
                    .raised = {raised("far_crest", Severity::warning, 1, 2),
                               raised("still_moving", Severity::questionable, 1, 2)},
                    .unstable = Unstable{1, 1, 0.8, ""},
                    .same_results = {{"a", "b"}}});
    std::vector<std::string> codes;
    for (const Reason& each : verdict.reasons) codes.push_back(each.code);
    EXPECT_EQ(codes, (std::vector<std::string>{"does_not_stand", "still_moving", "far_crest",
                                               "same_results"}));
    EXPECT_NE(line_of(verdict).find("; 1 of 2 runouts still moving: lower bounds"),
              std::string::npos)
        << line_of(verdict);
}

TEST(Verdict, SaysOnceWhatSeveralPhasesSayOfOneScene) {
    Raised fem = raised("implausible", Severity::warning, 1, 1);
    fem.phase = "fem_solver";
    const Verdict verdict = verdict_of(
        {.state = "succeeded", .raised = {fem, raised("implausible", Severity::warning, 3, 4)}});
    ASSERT_EQ(verdict.reasons.size(), 1u);
    EXPECT_NE(verdict.reasons[0].text.find("the FEM, 3 of 4 runouts"), std::string::npos)
        << verdict.reasons[0].text;
}

TEST(Verdict, IsNotFinishedWhileTheRunGoesOn) {
    EXPECT_EQ(verdict_of({.state = "running"}).usable, Usable::not_finished);
    EXPECT_EQ(
        verdict_of({.state = "failed", .broken = {{"fem_solver", 1, 1, "fem: full disk"}}}).usable,
        Usable::in_part);
}

TEST(Verdict, CountsWhatEachReasonIsAbout) {
    const json reasons =
        as_json(verdict_of({.state = "questionable",
                            .raised = {raised("still_moving", Severity::questionable, 7, 8)},
                            .unstable = Unstable{2, 3, 0.8, "loose"}}))
            .at("reasons");
    EXPECT_EQ(reasons.at(0).at("count"), 2);
    EXPECT_EQ(reasons.at(1).at("count"), 7);
}

TEST(Governing, IsTheLargestRunoutElseTheLeastFactorOfSafety) {
    EXPECT_EQ(governing({}), std::nullopt);
    EXPECT_EQ(governing({{}, {.runout = {}}}), std::nullopt);
    EXPECT_EQ(governing({{.factor_of_safety = 1.4}, {.factor_of_safety = 1.1}}), 1u);
    EXPECT_EQ(governing({{.factor_of_safety = 1.1}, {.runout = -3.0}, {.runout = 20.0}}), 2u);
}

TEST(Governing, OfRepeatsIsTheLargestInTheLargestMean) {
    EXPECT_EQ(governing({{.runout = 30.0, .mean_runout = 18.0},
                         {.runout = 19.0, .mean_runout = 20.0},
                         {.runout = 21.0, .mean_runout = 20.0}}),
              2u);
}

TEST(Flags, MakeDistancesLowerBoundsWhereTheSoilStillMoves) {
    const json moving = json::array({{{"code", "still_moving"}}});
    EXPECT_TRUE(still_moves(json(false), json::array()));
    EXPECT_TRUE(still_moves(json(true), moving));
    EXPECT_FALSE(still_moves(json(true), json::array()));
    EXPECT_FALSE(still_moves(json()));
    EXPECT_TRUE(grows("runout_beyond_toe"));
    EXPECT_TRUE(grows("area_beyond_toe"));
    EXPECT_FALSE(grows("factor_of_safety"));
}

}  // namespace breach::findings::verdict_test
