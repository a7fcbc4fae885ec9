// The server's answers as text. JSON in, text out; no requests.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace breach::cli {

enum class RunEnd {
    not_yet,
    good,  ///< succeeded, perhaps questionable, or partial
    bad,   ///< failed or cancelled
};

RunEnd end_of(const nlohmann::json& run);
/// Whether the run's verdict is that its results are unreliable.
bool is_doubtful(const nlohmann::json& run);
/// "not usable: does not stand as built, ..." for a run; empty without any objection.
std::string warning_of(const nlohmann::json& run);
/// Whether the task will have no further attempt.
bool is_final_task(const nlohmann::json& task);

/// GET /v1/runs
std::string as_run_table(const nlohmann::json& runs);
/// GET /v1/runs/{id}: description, progress, tasks, faults of failed tasks, and cautions about the
/// results.
std::string as_run_page(const nlohmann::json& run);
/// GET /v1/tasks/{id}
std::string as_task_page(const nlohmann::json& task);
/// GET /v1/runs/{id}/results, with a legend of the flags that its rows carry.
std::string as_result_table(const nlohmann::json& answer);
/// Result and verdict of a run, with the reasons that the flags of these results (rows or tasks) do
/// not explain: their tables do.
std::string as_verdict(const nlohmann::json& headline, const nlohmann::json& verdict,
                       const nlohmann::json& results);
/// The means of the same answer, with their standard deviations and missing repeats; empty: the
/// study has no repeats.
std::string as_mean_table(const nlohmann::json& answer);
/// Lines of telemetry; the columns are the numbers and words of the first line.
std::string as_telemetry_table(const nlohmann::json& lines);

/// "[#####...............]  25 %  running  3 of 13 tasks  about 4 min left"
std::string as_progress_line(const nlohmann::json& run);
/// "mpm_solver  t_T 1.5 s"
std::string name_of_task(const nlohmann::json& task);
/// "failed (exit code 70): the disk is full", "succeeded, ended: entangled at 6.7 s",
/// "questionable (still_moving)", or only the state
std::string end_of_task(const nlohmann::json& task);

}  // namespace breach::cli
