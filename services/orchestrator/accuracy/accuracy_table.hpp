// The table of an accuracy study (accuracy_rows.hpp), read from the store each time, so it includes
// the results so far.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "services/orchestrator/accuracy/accuracy_rows.hpp"
#include "services/orchestrator/store/store.hpp"

namespace breach::orchestrator {

/// Nothing: the run is no accuracy study, or does not exist.
/// asked_error: replaces the study's.
std::optional<AccuracyTable> accuracy_table(const Store& store, const DataFolder& data,
                                            const std::string& run,
                                            std::optional<double> asked_error = {});

/// The answer of GET /v1/runs/{id}/accuracy, without the run's id and state.
nlohmann::json as_json(const AccuracyTable& table);

}  // namespace breach::orchestrator
