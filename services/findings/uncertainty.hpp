// What an uncertainty study found, and what must be known before its numbers are believed, in sentences.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace breach::findings {

/// answer: that of GET /v1/runs/{id}/uncertainty so far.
std::vector<std::string> sentences_of(const nlohmann::json& answer);
/// What its numbers leave out, and which are lower bounds.
std::vector<std::string> cautions_of(const nlohmann::json& answer);

}  // namespace breach::findings
