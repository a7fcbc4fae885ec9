#include "services/cli/views.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace breach::cli {

using nlohmann::json;

namespace {

const json failed_task =
    json::parse(R"({"id": "R-00002", "run": "R", "phase": "mpm_solver", "label": "mpm_1",
    "transfer_time": 1.5, "state": "failed", "progress": 1, "message": "", "result": null,
    "fault": {"exit_code": 70, "summary": "entangled"}, "artifacts": [],
    "attempts": [{"number": 1, "state": "exited", "started": "2026-11-21T02:38:53.123Z", "finished": null,
                  "exit_code": 70, "wall_seconds": 2.0, "cpu_seconds": 1.25},
                 {"number": 2, "state": "exited", "started": null, "finished": null, "exit_code": 70,
                  "wall_seconds": 2.0, "cpu_seconds": 1.5}]})");

json run_with(const json& task) {
    return {{"id", "R"},
            {"name", "sweep"},
            {"title", "a title"},
            {"state", "failed"},
            {"created", "2026-11-21T02:38:53.123Z"},
            {"started", nullptr},
            {"finished", nullptr},
            {"progress", 1.0},
            {"tasks_total", 1},
            {"tasks_done", 1},
            {"tasks_failed", 1},
            {"message", "why"},
            {"headline", {{"text", ""}}},
            {"verdict", {{"usable", "no"}, {"words", "not usable"}, {"reasons", json::array()}}},
            {"tasks", json::array({task})}};
}

}  // namespace

TEST(RunState, SaysWhetherItIsOverAndHow) {
    for (const char* state : {"queued", "running", "a state of a later version"})
        EXPECT_EQ(end_of({{"state", state}}), RunEnd::not_yet) << state;
    for (const char* state : {"succeeded", "questionable", "partial"})
        EXPECT_EQ(end_of({{"state", state}}), RunEnd::good) << state;
    for (const char* state : {"failed", "cancelled"})
        EXPECT_EQ(end_of({{"state", state}}), RunEnd::bad) << state;
}

TEST(RunPage, SaysWhyATaskFailedAndWhatItsAttemptsCost) {
    const std::string page = as_run_page(run_with(failed_task));
    EXPECT_NE(page.find("R-00002  failed (exit code 70): entangled\n"), std::string::npos) << page;
    EXPECT_NE(page.find(" 2.75"), std::string::npos) << "CPU seconds of both attempts\n" << page;
    EXPECT_NE(page.find("created   2026-11-21 02:38:53\n"), std::string::npos) << page;
}

TEST(TaskPage, ListsAttempts) {
    const std::string page = as_task_page(failed_task);
    EXPECT_NE(page.find("mpm_solver  t_T 1.5 s\n"), std::string::npos) << page;
    EXPECT_NE(page.find("      2  exited"), std::string::npos) << page;
}

TEST(ProgressLine, SaysWhenTheRunWillBeReady) {
    const json run = {{"progress", 0.25},
                      {"state", "running"},
                      {"tasks_done", 3},
                      {"tasks_total", 13},
                      {"seconds_left", 185.0}};
    const std::string line = as_progress_line(run);
    EXPECT_NE(line.find("3 of 13 tasks"), std::string::npos) << line;
    EXPECT_NE(line.find("about 4 min left"), std::string::npos) << line;
    const std::string end = as_progress_line({{"progress", 1.0},
                                              {"state", "succeeded"},
                                              {"seconds_left", nullptr},
                                              {"headline", {{"text", "stands"}}}});
    EXPECT_EQ(end.find("left"), std::string::npos);
    EXPECT_TRUE(end.ends_with("  stands")) << end;
}

const json columns = json::parse(R"([
    {"name": "transfer_time", "kind": "number", "unit": "s", "title": "t_T", "meaning": ""},
    {"name": "state", "kind": "word", "unit": "", "title": "state", "meaning": ""},
    {"name": "runout", "kind": "number", "unit": "m", "title": "runout", "meaning": "", "grows": true},
    {"name": "mpm_task", "kind": "word", "unit": "", "title": "", "meaning": ""},
    {"name": "variant", "kind": "word", "unit": "", "title": "variant", "meaning": ""},
    {"name": "at_rest", "kind": "yes_no", "unit": "", "title": "rest", "meaning": ""},
    {"name": "volume_ratio", "kind": "number", "unit": "1", "title": "volume ratio", "meaning": ""}
    ])");

std::string table_of(const char* rows) {
    return as_result_table({{"columns", columns}, {"rows", json::parse(rows)}});
}

TEST(ResultTable, ShowsADashWhereThereIsNoRunoutAndTheReason) {
    EXPECT_EQ(table_of(R"([
        {"transfer_time": 0.5, "state": "succeeded", "runout": 12.345678, "volume_ratio": 0.99, "at_rest": true,
         "questionable": false, "flags": [], "reason": "", "variant": ""},
        {"transfer_time": 1.0, "state": "failed", "runout": null, "reason": "no memory", "variant": ""}])"),
              "t_T [s]  state      rest  runout [m]  volume ratio\n"
              "    0.5  succeeded  yes        12.35          0.99\n"
              "      1  failed     -              -             -  no memory\n");
}

TEST(Verdict, FollowsTheResultAndGivesTheReasonsThatNoFlagOfARowExplains) {
    const json headline{{"outcome", "flows"}, {"text", "flows 3 m beyond the toe"}};
    const json verdict = json::parse(R"({"usable": "no", "words": "not usable", "reasons": [
        {"code": "does_not_stand", "text": "It falls."},
        {"code": "coarse_cells", "text": "Coarse cells, 1 of 2 runouts: 3 cells."},
        {"code": "coarse_cells", "text": "Coarse cells, at submission: 2 cells."}]})");
    const json rows = json::parse(R"([{"flags": [{"code": "coarse_cells", "severity": "warning",
        "message": "3 cells"}]}, {"flags": null}])");
    EXPECT_EQ(as_verdict(headline, verdict, rows),
              "Result: flows 3 m beyond the toe\nVerdict: not usable\n  It falls.\n"
              "  Coarse cells, at submission: 2 cells.\n\n");
    EXPECT_EQ(as_verdict({{"text", ""}}, {{"words", "usable"}, {"reasons", json::array()}},
                         json::array()),
              "Verdict: usable\n\n");
}

TEST(MeanTable, ListsScatterAndMissingRepeats) {
    json answer = json::parse(R"({"means": [
        {"transfer_time": 0.5, "variant": "", "state": "partial", "draws": 3, "draws_done": 2, "runout": 12.5,
         "runout_deviation": 0.25, "runout_beyond_toe": 12.5, "runout_beyond_toe_deviation": 0.25, "runout_largest": 14,
         "runout_largest_deviation": 1, "runout_error": 1.116, "missing_draws": "d2: failed", "questionable_draws": "d3"}]})");
    const std::string text = as_mean_table(answer);
    EXPECT_TRUE(text.starts_with("t_T [s]  state    repeats  mean runout [m]    +-")) << text;
    EXPECT_NE(text.find("0.5      partial  2 of 3              12.5  0.25"), std::string::npos)
        << text;
    EXPECT_NE(text.find("1.116  missing repeats: d2: failed; questionable repeats: d3\n"),
              std::string::npos)
        << text;
    EXPECT_EQ(as_mean_table({{"rows", json::array()}}), "");
    answer["means"][0]["lower_bound"] = true;
    EXPECT_NE(as_mean_table(answer).find("\u2265 12.5  0.25"), std::string::npos);
}

TEST(ResultTable, NamesTheVariantMarksWhatMovesAndExplainsTheFlags) {
    EXPECT_EQ(table_of(R"([
        {"transfer_time": 0.5, "state": "questionable", "runout": 12, "at_rest": false, "lower_bound": true,
         "variant": "weak", "questionable": true, "flags": [
             {"code": "still_moving", "severity": "questionable", "message": "15 % left; lengthen", "pointer": ""},
             {"code": "implausible", "severity": "warning", "message": "1.9 kg/m3", "pointer": "/a"}]},
        {"transfer_time": 0.5, "state": "questionable", "runout": 11, "at_rest": false, "variant": "strong",
         "questionable": true, "flags": [
             {"code": "still_moving", "severity": "questionable", "message": "3 % left; lengthen", "pointer": ""},
             {"code": "implausible", "severity": "warning", "message": "1.9 kg/m3", "pointer": "/a"}]},
        {"transfer_time": 1, "state": "succeeded", "runout": 9, "at_rest": true, "variant": "strong",
         "questionable": false, "lower_bound": false, "flags": []}])"),
              "variant  t_T [s]  state         rest    runout [m]  volume ratio\n"
              "weak         0.5  questionable  MOVING        ≥ 12             -  a b\n"
              "strong       0.5  questionable  MOVING          11             -  a b\n"
              "strong         1  succeeded     yes              9             -\n"
              "\n"
              "a  still_moving (questionable), 2 of 3 rows\n"
              "   weak, t_T 0.5 s: 15 % left; lengthen\n"
              "b  implausible (warning), 2 of 3 rows\n"
              "   1.9 kg/m3\n");
}

TEST(RunList, SaysWhyARunIsQuestionable) {
    json run = run_with(failed_task);
    run["state"] = "questionable";
    run["message"] = "7 of 8 runouts still moving: lower bounds";
    run["verdict"] = {{"usable", "questionable"}, {"words", "questionable"}};
    EXPECT_NE(as_run_table(json::array({run}))
                  .find("questionable: 7 of 8 runouts still moving: lower bounds\n"),
              std::string::npos);
    EXPECT_EQ(end_of(run), RunEnd::good);
    EXPECT_TRUE(is_doubtful(run));
}

TEST(TransferBeyondTheFemsEnd, WasNotReachedAndHasNotFailed) {
    json task = failed_task;
    task["state"] = "skipped";
    task["not_reached"] = true;
    task["fault"] = {{"exit_code", nullptr}, {"summary", "the FEM ended entangled at 6.7 s"}};
    EXPECT_EQ(end_of_task(task), "not_reached: the FEM ended entangled at 6.7 s");
}

TEST(EntangledFem, HasEndedAndHasNotFailed) {
    json task = failed_task;
    task["phase"] = "fem_solver";
    task["state"] = "succeeded";
    task["fault"] = nullptr;
    task["ended"] = "entangled";
    task["end_time"] = 6.7;
    task["questionable"] = false;
    task["flags"] = json::parse(
        R"([{"code": "entangled", "severity": "warning", "message": "element 12 folded", "pointer": ""}])");
    EXPECT_EQ(end_of_task(task), "succeeded, ended: entangled at 6.7 s");
    const std::string page = as_run_page(run_with(task));
    EXPECT_NE(page.find("ended: entangled at 6.7 s"), std::string::npos) << page;
    EXPECT_NE(page.find("a  entangled (warning), 1 results\n   element 12 folded\n"),
              std::string::npos)
        << page;
    EXPECT_EQ(page.find("exit code"), std::string::npos) << page;
    task["questionable"] = true;
    task["flags"][0]["code"] = "entangled_corner";
    EXPECT_EQ(end_of_task(task), "questionable (entangled_corner), ended: entangled at 6.7 s");
}

TEST(TelemetryTable, LeavesOutWhatIsNoNumberOrWord) {
    EXPECT_EQ(as_telemetry_table(json::parse(R"([{"a": 1, "deep": {"b": 2}}, {"a": 22}])")),
              " a\n 1\n22\n");
    EXPECT_EQ(as_telemetry_table(json::array()), "");
}

}  // namespace breach::cli
