// Checks the error of an accuracy study with new repeats of a setting. A run whose study has the
// entry "check" averages its repeats in groups; each mean is within the requested error of the
// reference or not.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "services/orchestrator/accuracy/accuracy_rows.hpp"
#include "services/orchestrator/store/store.hpp"

namespace breach::orchestrator {

constexpr std::size_t most_repeats_of_a_check = 100;

/// The setting to check: a row of the table, and the number of its repeats in a mean.
struct CheckRequest {
    std::size_t repeats = 10;  ///< number of means; a study limits repeats * mean_of
    std::optional<std::string> ladder = {};
    std::optional<std::size_t> step = {};  ///< from 1; nothing: the recommended setting
    std::optional<std::size_t> mean_of = {};
};

/// The study that repeats the setting on lattices that the accuracy study has not used. Throws
/// BadInput, with pointers into the request, when there is no such setting, or none is recommended.
nlohmann::json study_of_check(const Store& store, const std::string& run,
                              const AccuracyTable& table, const CheckRequest& request);

/// Nothing: the run is no such check, or does not exist.
std::optional<BlindCheck> blind_check(const Store& store, const DataFolder& data,
                                      const std::string& run);

/// The answer of GET /v1/runs/{id}/accuracy/check, without the run's id and state.
nlohmann::json as_json(const BlindCheck& check);

}  // namespace breach::orchestrator
