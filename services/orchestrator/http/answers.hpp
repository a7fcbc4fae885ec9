// The answers of the API: records as JSON, as openapi.json describes them. Also used for folders
// without a service (report_questions.cpp).
#pragma once

#include <nlohmann/json.hpp>

#include "core/fault/fault.hpp"
#include "services/orchestrator/accuracy/runout_error.hpp"
#include "services/orchestrator/dispatch/progress_board.hpp"
#include "services/orchestrator/records/records.hpp"
#include "services/orchestrator/records/result_columns.hpp"
#include "services/orchestrator/store/store.hpp"

namespace breach::orchestrator {

/// board: progress of running tasks, in memory; an empty board stands for a run that has ended.
nlohmann::json as_json(const Run& run, const Store& store, const ProgressBoard& board);
nlohmann::json as_json(const Task& task, const std::vector<Attempt>& attempts,
                       const std::vector<Artifact>& artifacts, const ProgressBoard& board);
nlohmann::json as_json(const Event& event);
nlohmann::json as_json(const std::vector<fault::Fault>& faults);

using Columns = std::span<const ResultColumn>;

/// [{"runout": ...}, ...], keyed by column name. Written as text directly, as tables may be long.
std::string as_json_text(const std::vector<ResultRow>& rows, Columns columns);
/// Description of the columns of a table of results: [{name, kind, unit, title, meaning}].
nlohmann::json described(Columns columns);
nlohmann::json schema_of_rows(Columns columns);
/// The text of an object to be continued: "{...," instead of "{...}".
std::string opened(const nlohmann::json& object);
/// GET /v1/runs/{id}/results as JSON. rows, means: with their errors (accuracy/runout_error.hpp).
std::string results_text(const Store& store, Run run, const std::vector<ResultRow>& rows,
                         const std::vector<ResultRow>& means, const AllRows& all_rows);

/// RFC 4180, one line per transfer time, the names of the JSON answer in the first line.
std::string as_csv(const std::vector<ResultRow>& rows, Columns columns);

}  // namespace breach::orchestrator
