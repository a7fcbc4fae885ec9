// Findings of an uncertainty study and cautions about its numbers, in sentences.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace breach::findings {

/// answer: that of GET /v1/runs/{id}/uncertainty so far, without these sentences.
std::vector<std::string> sentences_of(const nlohmann::json& answer);
/// Cautions: samples missing from the numbers, and numbers that are lower bounds.
std::vector<std::string> cautions_of(const nlohmann::json& answer);

}  // namespace breach::findings
