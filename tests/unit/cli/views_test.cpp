#include "services/cli/views.hpp"

#include <gtest/gtest.h>

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
            {"tasks", json::array({task})}};
}

}  // namespace

TEST(RunState, SaysWhetherItIsOverAndHow) {
    for (const char* state : {"queued", "running", "a state of a later version"})
        EXPECT_EQ(end_of({{"state", state}}), RunEnd::not_yet) << state;
    for (const char* state : {"succeeded", "partial"})
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
    EXPECT_EQ(as_progress_line({{"progress", 1.0}, {"seconds_left", nullptr}}).find("left"),
              std::string::npos);
}

TEST(ResultTable, ShowsADashWhereThereIsNoRunoutAndTheReason) {
    const std::string table = as_result_table(json::parse(R"([
        {"transfer_time": 0.5, "state": "succeeded", "runout": 12.345678, "runout_beyond_toe": 1, "runout_largest": 2,
         "volume_ratio": 0.99, "numerical_share": 0.01, "cpu_seconds": 3, "reason": ""},
        {"transfer_time": 1.0, "state": "failed", "runout": null, "reason": "entangled"}])"));
    EXPECT_NE(table.find("succeeded"), std::string::npos) << table;
    EXPECT_NE(table.find("failed"), std::string::npos) << table;
    EXPECT_NE(table.find("entangled\n"), std::string::npos) << table;
}

TEST(TelemetryTable, LeavesOutWhatIsNoNumberOrWord) {
    EXPECT_EQ(as_telemetry_table(json::parse(R"([{"a": 1, "deep": {"b": 2}}, {"a": 22}])")),
              " a\n 1\n22\n");
    EXPECT_EQ(as_telemetry_table(json::array()), "");
}

}  // namespace breach::cli
